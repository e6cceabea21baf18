// SPDX-License-Identifier: GPL-3.0-or-later
// A library that changes the arithmetic of the process that loads it, and of each new thread, as a
// library built with -ffast-math does when it starts (crtfastmath.o).
#include <dlfcn.h>
#include <pthread.h>
#include <signal.h>
#include <sys/time.h>
#include <xmmintrin.h>

namespace {

struct Start {
  void* (*run)(void*);
  void* argument;
};

void* run_with_changed_arithmetic(void* given) {
  const Start start = *static_cast<Start*>(given);
  delete static_cast<Start*>(given);
  _mm_setcsr(HOSTILE_MXCSR);
  return start.run(start.argument);
}

void on_alarm(int) {}

/// Without SA_RESTART: interrupts every waiting system call a thousand times a second.
void send_alarms() {
  struct sigaction action {};
  action.sa_handler = on_alarm;
  sigaction(SIGALRM, &action, nullptr);
  const itimerval often{{0, 1000}, {0, 1000}};
  setitimer(ITIMER_REAL, &often, nullptr);
}

[[gnu::constructor]] void change_arithmetic() {
  if (HOSTILE_ALARMS) send_alarms();
  _mm_setcsr(HOSTILE_MXCSR);
}

}  // namespace

extern "C" int pthread_create(pthread_t* thread, const pthread_attr_t* attributes,
                              void* (*run)(void*), void* argument) {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  return create(thread, attributes, run_with_changed_arithmetic, new Start{run, argument});
}
