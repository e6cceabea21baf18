// SPDX-License-Identifier: GPL-3.0-or-later
#include "codegen/use/python/algebra_thread.hpp"

#include <unistd.h>

#include <stdexcept>

#include "codegen/support/no_signals.hpp"

namespace regulus::detail {
namespace {

/// A thread of a process. It is never destroyed: a forked process cannot destroy the thread that it
/// does not have.
struct OfProcess {
  pid_t process;
  AlgebraThread* thread;
};

/// Callers hold Python's lock, so that two threads do not use it at once.
OfProcess& known_thread() {
  static OfProcess known{0, nullptr};
  return known;
}

}  // namespace

AlgebraThread& AlgebraThread::of_this_process() {
  OfProcess& known = known_thread();
  const pid_t process = ::getpid();
  if (known.thread != nullptr && known.process == process) return *known.thread;
  if (known.thread != nullptr && known.thread->is_busy_)
    throw std::runtime_error(
        "this process was forked while Regulus was at work in another thread; start processes "
        "with multiprocessing's method 'spawn' or 'forkserver'");
  known = {process, new AlgebraThread};
  return *known.thread;
}

void AlgebraThread::stop_in_this_process() {
  const OfProcess& known = known_thread();
  if (known.thread != nullptr && known.process == ::getpid()) known.thread->stop();
}

AlgebraThread::AlgebraThread() {
  const NoSignals no_signals;
  thread_ = std::thread([this] { run(); });
}

std::shared_ptr<AlgebraTask> AlgebraThread::add(AlgebraWork work) {
  auto task = std::make_shared<AlgebraTask>();
  task->work_ = std::move(work);
  const std::scoped_lock lock(mutex_);
  if (stopped_) {
    task->is_late_ = true;
    task->failure_ = std::make_exception_ptr(std::runtime_error("Python is ending"));
    task->state_ = AlgebraTask::State::kDone;
    return task;
  }
  is_busy_ = true;
  waiting_.push_back(task);
  added_.notify_one();
  return task;
}

bool AlgebraThread::wait(const AlgebraTask& task, std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  const bool done =
      done_.wait_for(lock, most, [&] { return task.state_ == AlgebraTask::State::kDone; });
  if (stopped_ && !task.is_late_) done_.wait(lock, [] { return false; });
  return done;
}

bool AlgebraThread::interrupt(AlgebraTask& task) {
  const std::scoped_lock lock(mutex_);
  task.interrupt_ = true;
  if (task.state_ != AlgebraTask::State::kWaiting) return false;
  std::erase_if(waiting_, [&](const auto& one) { return one.get() == &task; });
  task.state_ = AlgebraTask::State::kDone;
  return true;
}

void AlgebraThread::stop() {
  {
    const std::scoped_lock lock(mutex_);
    stopped_ = true;
    waiting_.clear();
    if (running_) running_->interrupt_ = true;
    added_.notify_one();
  }
  if (thread_.joinable()) thread_.join();
}

void AlgebraThread::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    is_busy_ = !waiting_.empty();
    added_.wait(lock, [this] { return stopped_ || !waiting_.empty(); });
    if (stopped_) return;
    running_ = waiting_.front();
    waiting_.pop_front();
    running_->state_ = AlgebraTask::State::kRunning;
    lock.unlock();
    try {
      running_->work_(running_->interrupt_);
    } catch (...) {
      running_->failure_ = std::current_exception();
    }
    running_->work_ = nullptr;  // what it holds is destroyed in this thread
    lock.lock();
    running_->state_ = AlgebraTask::State::kDone;
    running_.reset();
    done_.notify_all();
  }
}

}  // namespace regulus::detail
