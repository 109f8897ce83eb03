// What every function of the library does around its work: errors of one type, the floating-point environment that the
// exact predicates need, the caller's callback.
#pragma once

#include <atomic>
#include <cfenv>
#include <exception>
#include <filesystem>
#include <new>
#include <string>
#include <utility>

#include "delaunay/base/check.h"
#include "surface/base/controls.h"
#include "surface/library/deliso/deliso.h"
#include "surface/mesh/triangle_mesh.h"

namespace deliso {

// Rounding to nearest, with denormal numbers, whatever the caller has set; threads that are started inherit it.
class DefaultRounding {
 public:
  DefaultRounding() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  DefaultRounding(const DefaultRounding&) = delete;
  DefaultRounding& operator=(const DefaultRounding&) = delete;
  DefaultRounding(DefaultRounding&&) = delete;
  DefaultRounding& operator=(DefaultRounding&&) = delete;
  ~DefaultRounding() { std::fesetenv(&before_); }

 private:
  std::fenv_t before_{};
};

// Calls the function; every exception leaves as an Error.
template <class Function>
auto call_guarded(Function&& function) {
  const DefaultRounding rounding;
  try {
    return function();
  } catch (const Error&) {
    throw;
  } catch (const InputError& error) {
    throw Error(Error::Kind::kInput, error.what());
  } catch (const std::bad_alloc&) {
    throw Error(Error::Kind::kMemory, "not enough memory: expected more of it, or a smaller volume or region");
  } catch (const std::exception& error) {
    throw Error(Error::Kind::kBroken,
                std::string("an invariant of DelIso is broken, please report it: ") + error.what());
  }
}

// The caller's callback as the mesher takes it. Its exceptions wait until the mesher has ended.
class Watcher {
 public:
  explicit Watcher(const ProgressCallback& callback, std::atomic<bool>* stop = nullptr)
      : callback_(callback), stop_(stop != nullptr ? stop : &own_stop_) {}

  void show(const Progress& progress);
  void show(double fraction, std::string_view step);
  [[nodiscard]] const std::atomic<bool>* stop() const { return stop_; }
  [[nodiscard]] bool is_stopped() const { return stop_->load(); }
  // The callback's exception, if it threw one.
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  void tell(const StageProgress& progress);

  const ProgressCallback& callback_;
  std::atomic<bool> own_stop_{false};
  std::atomic<bool>* stop_;
  std::exception_ptr thrown_;
  double fraction_ = 0;
};

// As call_guarded, for functions that have no partial result: `work` gets a function to be called between steps with
// the fraction done and the step's name, which ends the work when the callback says so.
template <class Work>
auto call_watched(const ProgressCallback& callback, Work&& work) {
  Watcher watcher(callback);
  const auto step = [&](double fraction, std::string_view name) {
    watcher.show(fraction, name);
    if (watcher.is_stopped()) throw Error(Error::Kind::kStopped, "stopped by the caller's callback");
  };
  try {
    return call_guarded([&] { return work(step); });
  } catch (const Error&) {
    watcher.rethrow();
    throw;
  }
}

// The engine's parameters. Throws InputError when they contradict each other.
Parameters engine_parameters(const ParameterSet& set);

// The isovalue, or of a label's surface the one that it has: then NaN or the same may be asked for. Throws InputError
// for any other beside a label, which would say nothing.
double isovalue_of_field(const Parameters& parameters, double asked);

// Throws InputError for a name that the system would cut off.
const std::filesystem::path& checked_path(const std::filesystem::path& path);

// As many threads as asked for; 0: as many as the machine has. Throws InputError for a negative number.
int thread_count(int asked);

TriangleMesh engine_mesh(const Mesh& mesh);
Mesh public_mesh(const TriangleMesh& mesh);

}  // namespace deliso
