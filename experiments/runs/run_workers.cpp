#include "experiments/runs/run_workers.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <vector>

#include "delaunay/base/check.h"

namespace deliso {
namespace {

// A process that makes one run after the other.
struct Worker {
  pid_t process = -1;
  int to = -1;    // numbers of runs go in
  int from = -1;  // a line of JSON comes out for each
  std::string text;
  std::optional<std::size_t> run;
};

bool write_whole(int file, const char* data, std::size_t size) {
  while (size > 0) {
    const ssize_t count = write(file, data, size);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    data += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

// Until the pipe of numbers is closed.
[[noreturn]] void work(int in, int out, const std::function<void()>& begin, const MakeRun& make) {
  begin();
  for (std::size_t index = 0;;) {
    const ssize_t count = read(in, &index, sizeof index);
    if (count < 0 && errno == EINTR) continue;
    if (count != sizeof index) _exit(0);
    const std::optional<Json> record = make(index);
    const std::string line = (record ? record->dump(-1, ' ', false, Json::error_handler_t::replace) : "null") + "\n";
    if (!write_whole(out, line.data(), line.size())) _exit(0);
  }
}

Worker start(const std::function<void()>& begin, const MakeRun& make, const std::vector<Worker>& others) {
  std::array<int, 2> to{};
  std::array<int, 2> from{};
  const auto refuse = [] { throw InputError("--jobs: cannot start a process: " + std::string(std::strerror(errno))); };
  if (pipe2(to.data(), O_CLOEXEC) != 0) refuse();
  if (pipe2(from.data(), O_CLOEXEC) != 0) refuse();
  Worker worker;
  worker.process = fork();
  if (worker.process < 0) refuse();
  if (worker.process == 0) {
    // The ends of others must not be held open here, or they would never see them closed.
    for (const Worker& other : others) {
      close(other.to);
      close(other.from);
    }
    close(to[1]);
    close(from[0]);
    work(to[0], from[1], begin, make);
  }
  close(to[0]);
  close(from[1]);
  worker.to = to[1];
  worker.from = from[0];
  return worker;
}

void end(Worker& worker, int& status) {
  close(worker.to);
  close(worker.from);
  while (waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
  }
}

std::string ending_text(int status) {
  if (WIFSIGNALED(status)) return "its process was ended by signal " + std::to_string(WTERMSIG(status));
  return "its process ended with " + std::to_string(WEXITSTATUS(status));
}

class Pool {
 public:
  Pool(std::size_t count, int jobs, const std::function<void()>& begin, const MakeRun& make)
      : count_(count), begin_(begin), make_(make) {
    const auto most = static_cast<std::size_t>(jobs);
    while (workers_.size() < std::min(most, count)) workers_.push_back(start(begin_, make_, workers_));
  }
  ~Pool() {
    int status = 0;
    for (Worker& worker : workers_) end(worker, status);
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  void run(const std::function<bool()>& next_wanted, const std::function<void(WorkerResult)>& done) {
    for (;;) {
      for (Worker& worker : workers_) {
        if (!worker.run && next_ < count_ && next_wanted()) give(worker);
      }
      std::vector<pollfd> waiting;
      for (const Worker& worker : workers_) {
        if (worker.run) waiting.push_back({worker.from, POLLIN, 0});
      }
      if (waiting.empty()) return;
      if (poll(waiting.data(), waiting.size(), -1) < 0 && errno != EINTR) return;
      std::size_t i = 0;
      for (Worker& worker : workers_) {
        if (worker.run && (waiting[i++].revents & (POLLIN | POLLHUP)) != 0) take(worker, done);
      }
    }
  }

 private:
  void give(Worker& worker) {
    worker.run = next_++;
    // Where the process is gone its end is seen when the answer is read.
    static_cast<void>(write_whole(worker.to, reinterpret_cast<const char*>(&*worker.run), sizeof *worker.run));
  }

  // What has come of a worker's answer; a process that ended gets a successor.
  void take(Worker& worker, const std::function<void(WorkerResult)>& done) {
    std::array<char, 1 << 16> buffer{};
    const ssize_t count = read(worker.from, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) return;
    WorkerResult result;
    result.index = *worker.run;
    if (count <= 0) {
      int status = 0;
      end(worker, status);
      result.failure = ending_text(status);
      std::vector<Worker> others;
      for (const Worker& other : workers_) {
        if (&other != &worker) others.push_back(other);
      }
      worker = start(begin_, make_, others);
      return done(std::move(result));
    }
    worker.text.append(buffer.data(), static_cast<std::size_t>(count));
    if (!worker.text.ends_with('\n')) return;
    const Json answer = Json::parse(worker.text, nullptr, false);
    worker.text.clear();
    worker.run.reset();
    if (answer.is_object()) {
      result.record = answer;
    } else {
      result.is_stopped = true;
    }
    done(std::move(result));
  }

  std::size_t count_;
  const std::function<void()>& begin_;
  const MakeRun& make_;
  std::size_t next_ = 0;
  std::vector<Worker> workers_;
};

}  // namespace

void run_side_by_side(std::size_t count, int jobs, const std::function<void()>& begin, const MakeRun& make,
                      const std::function<bool()>& next_wanted, const std::function<void(WorkerResult)>& done) {
  std::signal(SIGPIPE, SIG_IGN);  // a process that is gone is seen when its answer is read
  Pool(count, jobs, begin, make).run(next_wanted, done);
}

}  // namespace deliso
