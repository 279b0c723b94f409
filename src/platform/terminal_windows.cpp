// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <io.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>

#include "platform/terminal.hpp"
#include "platform/windows.hpp"
// Needs windows.hpp.
#include <shellapi.h>

namespace trueaxis::platform {
namespace {

HANDLE handle_of(Stream stream) {
  return ::GetStdHandle(stream == Stream::output ? STD_OUTPUT_HANDLE : STD_ERROR_HANDLE);
}

/// A terminal shows UTF-8 and knows escape codes; afterwards it is as it was.
void prepare_terminal() {
  static const UINT code_page_before = ::GetConsoleOutputCP();
  if (code_page_before != 0 && ::SetConsoleOutputCP(CP_UTF8) != 0)
    std::atexit([] { ::SetConsoleOutputCP(code_page_before); });
  for (const Stream stream : {Stream::output, Stream::error}) {
    DWORD mode = 0;
    if (::GetConsoleMode(handle_of(stream), &mode) != 0)
      ::SetConsoleMode(handle_of(stream), mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
  }
}

}  // namespace

bool is_terminal(Stream stream) {
  DWORD mode = 0;
  return ::GetConsoleMode(handle_of(stream), &mode) != 0;
}

std::optional<std::size_t> columns_of(Stream stream) {
  CONSOLE_SCREEN_BUFFER_INFO screen{};
  if (::GetConsoleScreenBufferInfo(handle_of(stream), &screen) == 0) return std::nullopt;
  return static_cast<std::size_t>(screen.srWindow.Right - screen.srWindow.Left + 1);
}

std::vector<std::string> begin_program(int, char**) {
  for (std::FILE* file : {stdin, stdout, stderr}) ::_setmode(::_fileno(file), _O_BINARY);
  prepare_terminal();
  std::vector<std::string> words;
  int count = 0;
  wchar_t** const wide_words = ::CommandLineToArgvW(::GetCommandLineW(), &count);
  for (int i = 1; i < count; ++i) words.push_back(narrow(wide_words[i]));
  ::LocalFree(wide_words);
  return words;
}

void on_stop(void (*stop)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGBREAK})
    std::signal(signal, stop == nullptr ? SIG_DFL : stop);
}

bool open_in_browser(const std::string& path) {
  const std::wstring relative = wide(path);
  std::wstring file(::GetFullPathNameW(relative.c_str(), 0, nullptr, nullptr), L'\0');
  ::GetFullPathNameW(relative.c_str(), static_cast<DWORD>(file.size()), file.data(), nullptr);
  const HINSTANCE done =
      ::ShellExecuteW(nullptr, L"open", file.c_str(), nullptr, nullptr, SW_SHOWNORMAL);
  return reinterpret_cast<std::intptr_t>(done) > 32;  // as Windows documents it
}

bool terminal_is_own() {
  DWORD processes[2];
  return ::GetConsoleProcessList(processes, 2) == 1;
}

}  // namespace trueaxis::platform
