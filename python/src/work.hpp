// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>
#include <thread>
#include <utility>

#include "base/stop.hpp"

namespace trueaxis::python {

namespace py = pybind11;

/// Looks this often whether Ctrl-C was pressed, and calls `progress`.
constexpr auto look_every = std::chrono::milliseconds(50);

/// What `work` returns, with Python free to run meanwhile. `work` touches no Python object.
template <class Work>
auto without_python(Work&& work) {
  const py::gil_scoped_release released;
  return work();
}

/// The same for long work: a signal of Python (Ctrl-C), or what `progress(seconds, share)` raises,
/// ends it.
/// @param progress None, or a function of the seconds since the beginning and of the share done,
/// None unless the work counts
template <class Work>
auto stoppable(const py::object& progress, Work&& work) {
  using Clock = std::chrono::steady_clock;
  std::atomic<bool> asked = false;
  std::atomic<double> share = -1.0;
  const auto begun = Clock::now();
  auto result = std::async(std::launch::async, [&] {
    const Stoppable scope(&asked, &share);
    return work();
  });
  const auto ready_in = [&](auto time) {
    const py::gil_scoped_release released;
    return result.wait_for(time) == std::future_status::ready;
  };
  try {
    while (!ready_in(look_every)) {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (progress.is_none()) continue;
      const double done = share;
      progress(std::chrono::duration<double>(Clock::now() - begun).count(),
               done < 0.0 ? py::object(py::none()) : py::object(py::float_(done)));
    }
  } catch (py::error_already_set&) {
    asked = true;
    ready_in(std::chrono::hours(24));
    throw;
  }
  return result.get();
}

}  // namespace trueaxis::python
