// Work of the library that Python can watch and interrupt: it runs in a thread of its own, without the interpreter's
// lock, while the thread that called looks for signals and calls Python's callback.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "surface/library/deliso/deliso.h"

namespace deliso::python {

namespace py = pybind11;

// What the two threads share. The work keeps it alive.
template <class Result>
struct SharedRun {
  std::mutex mutex;
  std::condition_variable changed;
  bool is_done = false;
  std::optional<std::pair<std::string, double>> news;  // stage and fraction, not told yet
  std::optional<Result> result;
  std::exception_ptr error;
  std::atomic<bool> stop{false};
};

// Looks once for signals. The first Ctrl-C asks the work to stop; what else a handler raises, or a second Ctrl-C, is
// returned.
inline std::optional<py::error_already_set> look_for_signals(int& interrupts, std::atomic<bool>& stop) {
  if (PyErr_CheckSignals() == 0) return std::nullopt;
  py::error_already_set raised;
  stop = true;
  if (raised.matches(PyExc_KeyboardInterrupt) && ++interrupts == 1) return std::nullopt;
  return raised;
}

// False of Python or of numpy; None is not.
inline bool is_false(const py::object& answer) {
  const std::string_view type = Py_TYPE(answer.ptr())->tp_name;
  return (type == "bool" || type == "numpy.bool_" || type == "numpy.bool") && PyObject_IsTrue(answer.ptr()) == 0;
}

// Calls work(progress, stop) and returns what it returns. After a first Ctrl-C it is asked to stop. A second one leaves
// it to itself and raises KeyboardInterrupt at once; `kept`, what the work reads, is then never released. `progress` is
// None or is called as progress(stage, fraction); False stops, an exception stops and is raised.
template <class Result, class Work>
Result run_interruptible(Work work, const py::object& progress, const py::object& kept, int& interrupts) {
  const auto run = std::make_shared<SharedRun<Result>>();
  std::thread thread([run, work = std::move(work)] {
    const ProgressCallback tell = [&run](const StageProgress& told) {
      const std::lock_guard lock(run->mutex);
      run->news = {std::string(told.stage), told.fraction};
      run->changed.notify_one();
      return !run->stop.load();
    };
    std::optional<Result> result;
    std::exception_ptr error;
    try {
      result = work(tell, run->stop);
    } catch (...) {
      error = std::current_exception();
    }
    const std::lock_guard lock(run->mutex);
    run->result = std::move(result);
    run->error = error;
    run->is_done = true;
    run->changed.notify_one();
  });
  std::optional<py::error_already_set> raised;
  for (bool is_done = false; !is_done;) {
    std::optional<std::pair<std::string, double>> news;
    {
      const py::gil_scoped_release unlocked;
      std::unique_lock lock(run->mutex);
      constexpr std::chrono::milliseconds kBetweenLooks(50);
      run->changed.wait_for(lock, kBetweenLooks, [&] { return run->is_done; });
      news.swap(run->news);
      is_done = run->is_done;
    }
    if (auto error = look_for_signals(interrupts, run->stop)) {
      kept.inc_ref();
      thread.detach();
      throw std::move(*error);
    }
    if (progress.is_none() || !news || raised || run->stop) continue;
    try {
      if (is_false(progress(news->first, news->second))) run->stop = true;
    } catch (py::error_already_set& error) {
      run->stop = true;
      // Ctrl-C within the callback is a Ctrl-C, too.
      if (!error.matches(PyExc_KeyboardInterrupt) || ++interrupts > 1) raised = std::move(error);
    }
  }
  thread.join();
  if (raised) throw std::move(*raised);
  if (run->error) std::rethrow_exception(run->error);
  return std::move(*run->result);
}

}  // namespace deliso::python
