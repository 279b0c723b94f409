// SPDX-License-Identifier: Apache-2.0
#include "interchange/zip_archive.hpp"

#include <zip.h>

#include <stdexcept>

#include "interchange/formats.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr zip_uint16_t no_date = 1U << 5U | 1U;  // 1980-01-01, the first that an archive can say

}  // namespace

ZipArchive::ZipArchive(std::string path, std::string_view bytes) : path_(std::move(path)) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(bytes.data(), bytes.size(), 0, &error);
  if (source != nullptr) {
    archive_ = zip_open_from_source(source, ZIP_RDONLY | ZIP_CHECKCONS, &error);
    if (archive_ == nullptr) zip_source_free(source);
  }
  const std::string why = zip_error_strerror(&error);
  zip_error_fini(&error);
  if (archive_ == nullptr)
    throw InputError(path_, "is not a complete zip archive (" + why + "): copy it again");
}

ZipArchive::~ZipArchive() { zip_discard(archive_); }

std::vector<std::string> ZipArchive::names() const {
  std::vector<std::string> names;
  const zip_int64_t count = zip_get_num_entries(archive_, 0);
  for (zip_int64_t i = 0; i < count; ++i)
    if (const char* name = zip_get_name(archive_, static_cast<zip_uint64_t>(i), 0))
      names.emplace_back(name);
  return names;
}

bool ZipArchive::has(const std::string& name) const {
  return zip_name_locate(archive_, name.c_str(), 0) >= 0;
}

std::string ZipArchive::member(const std::string& name) {
  const auto refuse = [&](const std::string& why) {
    throw InputError(path_, "its member " + name + " " + why);
  };
  zip_stat_t stat;
  zip_stat_init(&stat);
  if (zip_stat(archive_, name.c_str(), 0, &stat) != 0 || (stat.valid & ZIP_STAT_SIZE) == 0)
    refuse("is not there");
  if (stat.size > most_bytes - unpacked_)
    refuse("would unpack to " + std::to_string(stat.size >> 20U) +
           " MiB, more than TrueAxis reads from one file (2 GiB)");
  if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && stat.encryption_method != ZIP_EM_NONE)
    refuse("is encrypted");
  // Deflate packs to a thousandth and a little at best: if the header states more, no program wrote
  // the archive.
  if ((stat.valid & ZIP_STAT_COMP_SIZE) != 0 && stat.size > 1100 * stat.comp_size + 1024)
    refuse("says that it unpacks to " + std::to_string(stat.size) + " bytes from " +
           std::to_string(stat.comp_size) + ", which deflate cannot");
  zip_file_t* file = zip_fopen_index(archive_, stat.index, 0);
  if (file == nullptr) refuse(std::string("is broken (") + zip_strerror(archive_) + ")");
  std::string bytes(stat.size, '\0');
  const zip_int64_t got = zip_fread(file, bytes.data(), bytes.size());
  char more = 0;  // the sum of the whole is checked after its last byte
  const bool whole =
      got == static_cast<zip_int64_t>(bytes.size()) && zip_fread(file, &more, 1) == 0;
  const std::string why = zip_file_strerror(file);
  zip_fclose(file);
  if (!whole) refuse("is broken (" + why + ")");
  unpacked_ += bytes.size();
  return bytes;
}

std::string zip_of(const std::vector<std::pair<std::string, std::string>>& members) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(nullptr, 0, 0, &error);
  zip_t* archive = source == nullptr ? nullptr : zip_open_from_source(source, ZIP_TRUNCATE, &error);
  zip_error_fini(&error);
  if (archive == nullptr) throw std::runtime_error("no memory for a zip archive");
  zip_source_keep(source);
  bool good = true;
  for (const auto& [name, bytes] : members) {
    zip_source_t* of = zip_source_buffer(archive, bytes.data(), bytes.size(), 0);
    const zip_int64_t at = of == nullptr ? -1 : zip_file_add(archive, name.c_str(), of, 0);
    good = good && at >= 0;
    if (!good) break;
    const auto index = static_cast<zip_uint64_t>(at);
    // The first says what the archive is: it is at its beginning without compression.
    good = zip_file_set_dostime(archive, index, 0, no_date, 0) == 0 &&
           (index > 0 || zip_set_file_compression(archive, index, ZIP_CM_STORE, 0) == 0);
  }
  good = good && zip_close(archive) == 0;
  std::string out;
  if (good && zip_source_open(source) == 0) {
    zip_source_seek(source, 0, SEEK_END);
    out.resize(static_cast<std::size_t>(zip_source_tell(source)));
    zip_source_seek(source, 0, SEEK_SET);
    good = zip_source_read(source, out.data(), out.size()) == static_cast<zip_int64_t>(out.size());
    zip_source_close(source);
  }
  zip_source_free(source);
  if (!good) throw std::runtime_error("a zip archive could not be made");
  return out;
}

}  // namespace trueaxis
