// SPDX-License-Identifier: Apache-2.0
#include <pybind11/stl.h>

#include <iostream>
#include <mutex>
#include <sstream>

#include "cli/program.hpp"
#include "outcome.hpp"
#include "work.hpp"

namespace trueaxis::python {
namespace {

/// What is written to a stream of C++ while it lives.
class Captured {
 public:
  explicit Captured(std::ostream& of) : of_(of), before_(of.rdbuf(text_.rdbuf())) {}
  ~Captured() { of_.rdbuf(before_); }
  Captured(const Captured&) = delete;
  Captured& operator=(const Captured&) = delete;
  std::string text() const { return text_.str(); }

 private:
  std::ostringstream text_;
  std::ostream& of_;
  std::streambuf* before_;
};

struct Ran {
  int code = 0;
  std::string out, err;
};

/// One command at a time: the streams of C++ are those of the process.
Ran run(const std::vector<std::string>& words) {
  static std::mutex one_at_a_time;
  const std::lock_guard lock(one_at_a_time);
  const Captured out(std::cout), err(std::cerr);
  const int code = cli::guarded([&] { return cli::run_program(words); });
  return {code, out.text(), err.text()};
}

}  // namespace

void bind_command(py::module_& module) {
  module.def("command", [](const std::vector<std::string>& words, const py::object& progress) {
    const Ran ran = stoppable(progress, [&] { return run(words); });
    return py::make_tuple(ran.code, ran.out, ran.err);
  });
}

}  // namespace trueaxis::python
