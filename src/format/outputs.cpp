// SPDX-License-Identifier: Apache-2.0
#include "format/outputs.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <optional>
#include <utility>

#include "format/file.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {

namespace fs = std::filesystem;

namespace {

constexpr const char* part = ".part";  // and the number of the process that writes it

using platform::LockableFile;

/// Makes a new file next to a place, locks it and appends to `path` what makes its name new; none:
/// it cannot be made. Where files cannot be locked it is made all the same.
LockableFile made_beside(std::string& path) {
  path += part + platform::process_id();
  for (;;) {
    LockableFile file = LockableFile::make(path);
    if (!file.is_open() && errno != EEXIST) return file;
    if (!file.is_open()) {
      path += '_';
      continue;
    }
    // Otherwise another process took it for left over.
    if (file.lock() != LockableFile::Lock::taken && file.is_there()) return file;
  }
}

}  // namespace

OutputFile::OutputFile(const std::string& path)
    : path_(is_standard_output(path) ? "-" : path), place_(link_target(path_)) {
  if (path_ == "-") return;
  std::error_code error;
  const fs::file_status status = fs::status(place_, error);
  if (fs::is_directory(status)) fail("it is a folder");
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    file_.open(fs::path(place_), std::ios::binary);
  } else {
    beside_ = place_;
    lock_ = made_beside(beside_);
    if (lock_.is_open()) file_.open(fs::path(beside_), std::ios::binary);
  }
  if (file_.is_open()) return;
  const std::string why = std::strerror(errno);
  if (lock_.is_open()) fs::remove(beside_, error);
  beside_.clear();
  fail(why);
}

OutputFile::~OutputFile() {
  std::error_code ignored;
  file_.close();  // an open file cannot be removed everywhere
  if (!beside_.empty()) fs::remove(beside_, ignored);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : path_(std::move(other.path_)),
      place_(std::move(other.place_)),
      beside_(std::exchange(other.beside_, {})),
      lock_(std::move(other.lock_)),
      file_(std::move(other.file_)) {}

void OutputFile::write(std::string_view text) {
  std::ostream& out = path_ == "-" ? std::cout : file_;
  if (!out.write(text.data(), static_cast<std::streamsize>(text.size())))
    fail(std::strerror(errno));
}

void OutputFile::close() {
  if (path_ == "-") {
    if (!std::cout.flush()) fail(std::strerror(errno));
  } else if (file_.is_open()) {
    file_.close();
    if (!file_) fail(std::strerror(errno));
  }
}

void OutputFile::commit() {
  close();
  if (beside_.empty()) return;
  std::error_code error;
  fs::rename(beside_, place_, error);
  if (error) fail(error.message());
  beside_.clear();
}

void OutputFile::fail(const std::string& why) const {
  const std::string name = path_ == "-" ? "standard output" : path_;
  throw InputError(name, "cannot be written (" + why + "): name a place that can be written");
}

namespace {

constexpr const char* elsewhere = ": name another place for the result";

std::string cannot(const std::string& why) {
  return "cannot be written (" + why + "): name a place that can be written";
}

/// Why no file can be made in `folder`; empty: it can.
std::string why_not_in(fs::path folder) {
  if (folder.empty()) folder = ".";
  std::error_code error;
  const fs::file_status status = fs::status(folder, error);
  if (!fs::exists(status))
    return cannot("its folder " + folder.string() +
                  " does not exist, and TrueAxis does not create it");
  if (!fs::is_directory(status)) return cannot(folder.string() + " is not a folder");
  if (!platform::may_write_in(folder.string()))
    return cannot("its folder: " + std::string(std::strerror(errno)));
  return "";
}

}  // namespace

Outputs::~Outputs() {
  files_.clear();
  std::error_code ignored;
  if (made_folder_) fs::remove(folder_, ignored);  // an empty one only
}

void Outputs::reads(const std::string& path) { inputs_.push_back(path); }

void Outputs::into(const std::string& folder) {
  if (folder == "-")
    throw InputError("-", "is not a folder: give one, or let --json - print the result");
  const fs::path path = folder;
  folder_ = path.has_filename() ? folder : path.parent_path().string();
}

void Outputs::may_write(const std::string& path, const std::string& schema) {
  if (!path.empty()) places_.push_back({path, schema});
  checked_ = false;
}

void Outputs::may_begin(const std::string& path, std::string content, const std::string& schema) {
  if (!path.empty()) places_.push_back({path, schema, std::move(content)});
  checked_ = false;
}

void Outputs::may_write_in_folder(const std::string& name, const std::string& schema) {
  may_write(in_folder(name), schema);
}

std::string Outputs::in_folder(const std::string& name) const {
  return path_text(fs::path(folder_) / name);
}

/// Why the folder of the results cannot take them; empty: it can.
std::string Outputs::of_folder() const {
  if (folder_.empty()) return "";
  std::error_code error;
  const fs::file_status status = fs::status(folder_, error);
  if (fs::is_directory(status)) return why_not_in(folder_);
  if (fs::exists(fs::symlink_status(folder_, error)))
    return "is not a folder: name one for the results";
  return why_not_in(fs::path(folder_).parent_path());
}

/// Why a file must not or cannot be written; empty: it can.
std::string Outputs::objection(const Place& place) const {
  const std::optional<FileIdentity> identity = identity_of_output(place.path);
  if (identity) {
    for (const std::string& input : inputs_) {
      if (identity_of_input(input) == identity)
        return "is an input of this command (" + (input == "-" ? "standard input" : input) +
               "), which would be lost" + elsewhere;
    }
  }
  const bool printed = is_standard_output(place.path);
  for (const Place& other : places_) {
    if (&other == &place) break;
    if ((printed && is_standard_output(other.path)) ||
        (identity && identity_of_output(other.path) == identity))
      return "is the file that " + other.path + " goes to as well" + elsewhere;
  }
  if (printed) return "";
  const std::string target = link_target(place.path);
  std::error_code error;
  const fs::file_status status = fs::status(target, error);
  if (fs::is_directory(status)) return cannot("it is a folder");
  const fs::path folder = fs::path(target).parent_path();
  if (!fs::exists(status)) {
    const bool in_folder = !folder_.empty() && folder == fs::path(folder_);
    return in_folder ? "" : why_not_in(folder);
  }
  if (!fs::is_regular_file(status)) return "";
  if (std::string why = why_not_in(folder); !why.empty()) return why;
  if (!platform::may_write(target)) return cannot(std::strerror(errno));
  if (force_ || fs::file_size(target, error) == 0) return "";
  if (place.begins && read_file(target) == *place.begins) return "";
  const std::string found = place.schema.empty() ? "" : schema_of_file(target);
  if (place.begins && found == place.schema)
    return place.schema.empty()
               ? "is there and may hold your changes: name another place, or use --force"
               : "is there and may hold your readings or changes: name another place, or use "
                 "--force";
  if (found == place.schema) return "";
  return (found.empty() ? "is there and was not written by TrueAxis"
                        : "is there and is another result (" + found + ")") +
         elsewhere + ", or let it be replaced with --force";
}

std::vector<std::string> Outputs::places() const {
  std::vector<std::string> paths;
  for (const Place& place : places_) paths.push_back(place.path);
  return paths;
}

void Outputs::check() {
  std::vector<Diagnostic> diagnostics;
  const auto note = [&](const std::string& path, std::string why) {
    const std::string name = is_standard_output(path) ? "standard output" : path;
    if (!why.empty()) diagnostics.push_back({name, 0, 0, std::move(why)});
  };
  note(folder_, of_folder());
  if (diagnostics.empty()) {
    for (const Place& place : places_) note(place.path, objection(place));
  }
  if (!diagnostics.empty()) throw InputError(std::move(diagnostics));
  checked_ = true;
}

void Outputs::make_folder() {
  expects(checked_, "outputs that were checked");
  if (folder_.empty()) return;
  std::error_code error;
  made_folder_ = fs::create_directory(folder_, error) || made_folder_;
  if (error) throw InputError(folder_, cannot(error.message()));
}

/// Removes what runs that were killed have left next to a place: a file of their naming that nobody
/// holds and that is empty or begins as the result would.
void Outputs::remove_left_over(const Place& place) const {
  const fs::path target = link_target(place.path);
  const std::string start = target.filename().string() + part;
  std::error_code error;
  const fs::path folder = target.parent_path();
  for (const fs::directory_entry& entry :
       fs::directory_iterator(folder.empty() ? "." : folder, error)) {
    const std::string path = entry.path().string(), name = entry.path().filename().string();
    const std::string number = name.starts_with(start) ? name.substr(start.size()) : "";
    if (number.empty() || number.find_first_not_of("0123456789_") != std::string::npos ||
        entry.is_symlink(error) || !entry.is_regular_file(error))
      continue;
    const bool is_read = std::ranges::any_of(inputs_, [&](const std::string& input) {
      return identity_of_input(input) == identity_of_output(path);
    });
    // A result that says no schema is not known again: what is not empty may be the user's.
    const bool ours = entry.file_size(error) == 0 ||
                      (!place.schema.empty() && schema_of_file(path) == place.schema);
    if (is_read || !ours) continue;
    LockableFile file = LockableFile::existing(path);
    if (file.is_open() && file.lock() == LockableFile::Lock::held) fs::remove(path, error);
  }
}

OutputFile& Outputs::open(const std::string& path) {
  expects(checked_ && std::ranges::find(places_, path, &Place::path) != places_.end(),
          "outputs that were named and checked");
  if (files_.empty()) {
    make_folder();
    for (const Place& place : places_)
      if (!is_standard_output(place.path)) remove_left_over(place);
  }
  return files_.emplace_back(path);
}

void Outputs::write(const std::string& path, std::string_view content) {
  if (path.empty()) return;
  OutputFile& file = open(path);
  expects(
      schema_in(content.substr(0, 512)) == std::ranges::find(places_, path, &Place::path)->schema,
      "a result that says its schema");
  file.write(content);
  file.close();
}

std::string Outputs::set_aside(const std::string& path) {
  expects(checked_, "outputs that were checked");
  const auto place = std::ranges::find(places_, path, &Place::path);
  std::error_code error;
  if (is_standard_output(path) || !fs::exists(fs::symlink_status(path, error)) ||
      schema_of_file(path) != place->schema)
    return "";
  std::string name = path + ".kept";
  for (int n = 2; fs::exists(fs::symlink_status(name, error)); ++n)
    name = fmt::format("{}.kept{}", path, n);
  earlier_.push_back({path, name});
  return name;
}

bool Outputs::remove_unchanged(const std::string& path, const std::string& hash) {
  expects(checked_, "outputs that were checked");
  const bool is_read = std::ranges::any_of(inputs_, [&](const std::string& input) {
    return identity_of_input(input) == identity_of_output(path);
  });
  std::error_code error;
  if (is_read || !fs::is_regular_file(fs::symlink_status(path, error)) ||
      content_hash(read_file(path)) != hash)
    return false;
  earlier_.push_back({path, ""});
  return true;
}

void Outputs::commit() {
  const auto expect_moved = [](const std::string& path, const std::error_code& error) {
    if (error)
      throw InputError(path, "belongs to an earlier job and cannot be moved away (" +
                                 error.message() + "): do not use it");
  };
  for (OutputFile& file : files_) file.close();
  std::error_code error;
  for (const auto& [path, new_name] : earlier_) {  // before this run writes to the same place
    if (new_name.empty()) continue;
    fs::rename(path, new_name, error);
    expect_moved(path, error);
  }
  for (OutputFile& file : files_) file.commit();
  files_.clear();
  made_folder_ = false;
  for (const auto& [path, new_name] : earlier_) {
    if (!new_name.empty()) continue;
    fs::remove(path, error);
    expect_moved(path, error);
  }
}

}  // namespace trueaxis
