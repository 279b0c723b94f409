// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <optional>
#include <utility>

#include "base/stop.hpp"

namespace trueaxis::python {

namespace py = pybind11;

/// Looks no oftener than this whether Ctrl-C was pressed, and calls `progress`.
constexpr auto look_every = std::chrono::milliseconds(50);

/// What `work` returns, with Python free to run meanwhile. `work` touches no Python object.
template <class Work>
auto without_python(Work&& work) {
  const py::gil_scoped_release released;
  return work();
}

/// The same for long work: a signal of Python (Ctrl-C), or what `progress(seconds, share)` raises,
/// ends it where it next looks. It runs on the calling thread, whose memory is used again and
/// again.
/// @param progress None, or a function of the seconds since the beginning and of the share done,
/// None unless the work counts
template <class Work>
auto stoppable(const py::object& progress, Work&& work) {
  using Clock = std::chrono::steady_clock;
  std::atomic<bool> asked = false;
  std::atomic<double> share = -1.0;
  std::optional<py::error_already_set> raised;
  const auto begun = Clock::now();
  auto looked = begun;
  const std::function<void()> look = [&] {
    const auto now = Clock::now();
    if (asked || now - looked < look_every) return;
    looked = now;
    const py::gil_scoped_acquire held;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      if (progress.is_none()) return;
      const double done = share;
      progress(std::chrono::duration<double>(now - begun).count(),
               done < 0.0 ? py::object(py::none()) : py::object(py::float_(done)));
    } catch (const py::error_already_set& error) {
      raised = error;
      asked = true;
    }
  };
  try {
    const py::gil_scoped_release released;
    const Stoppable scope(&asked, &share, &look);
    auto result = work();
    if (!asked) return result;
  } catch (const Stopped&) {
  }
  throw py::error_already_set(*raised);
}

}  // namespace trueaxis::python
