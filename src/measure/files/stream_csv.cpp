// SPDX-License-Identifier: Apache-2.0
#include "measure/files/stream_csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <xxhash.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>
#include <string_view>

#include "format/csv_text.hpp"
#include "format/file.hpp"
#include "measure/files/stream_csv_header.hpp"
#include "measure/files/stream_csv_metadata.hpp"
#include "measure/files/stream_csv_rows.hpp"
#include "measure/kept_readings.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

constexpr std::size_t chunk_bytes = std::size_t{1} << 20U;
constexpr std::size_t longest_line_bytes = std::size_t{1} << 20U;

/// Takes whole lines and turns them into metadata, header and rows.
class LineReader {
 public:
  LineReader(ProbeStream& stream, CsvDiagnostics& diagnostics, const StreamReadOptions& options)
      : stream_(stream), diagnostics_(diagnostics), metadata_(diagnostics), options_(options) {}

  /// Lines from `p` to `end`; the last byte is '\n'. False: what follows cannot be read.
  bool block(const char* p, const char* end) {
    while (p < end) {
      ++line_number_;
      const char* next = rows_ ? rows_->fast_row(p, end) : nullptr;
      if (next == nullptr) {
        const auto* stop =
            static_cast<const char*>(std::memchr(p, '\n', static_cast<std::size_t>(end - p)));
        const std::size_t before = stream_.size();
        if (!line({p, static_cast<std::size_t>(stop - p)})) return false;
        note_without_row(before);
        next = stop + 1;
      }
      p = next;
    }
    return true;
  }

  /// Rows below the header that are numbers already.
  void rows(std::span<const double> numbers,
            const std::function<std::string(std::size_t)>& text_of) {
    const std::size_t width = header_.columns.size(),
                      count = width == 0 ? 0 : numbers.size() / width;
    if (rows_) rows_->reserve(count);
    for (std::size_t k = 0; k < count; ++k) {
      ++line_number_;
      if (rows_->take(numbers.subspan(k * width, width))) continue;
      const std::size_t before = stream_.size();
      rows_->any_row(text_of(k), line_number_);
      note_without_row(before);
    }
  }

  /// Columns below the header that are numbers already; all at once if nothing is unusual.
  void columns(std::span<const std::span<const double>> columns) {
    of_arrays_ = true;
    if (!rows_ || rows_->take_columns(columns)) return;
    std::vector<double> row(columns.size());
    for (std::size_t i = 0; i < columns.front().size(); ++i) {
      ++line_number_;
      std::ranges::transform(columns, row.begin(), [i](const auto& column) { return column[i]; });
      if (rows_->take(row)) continue;
      const std::size_t before = stream_.size();
      rows_->any_row(fmt::format("{}", fmt::join(row, ",")), line_number_);
      note_without_row(before);
    }
  }

  /// Room for the rows of a file of `total_bytes`, judged by those in its first `bytes`.
  void reserve_for(std::size_t total_bytes, std::size_t bytes) {
    const std::size_t rows = stream_.reading_mm.size();
    if (!rows_ || total_bytes <= bytes) return;
    const double ratio = static_cast<double>(total_bytes) / static_cast<double>(bytes);
    rows_->reserve(static_cast<std::size_t>(1.05 * ratio * static_cast<double>(rows)) + 1);
  }

  void too_long() {
    diagnostics_.add(line_number_ + 1, 0,
                     "the line is longer than 1 MiB: this is not a text table");
  }

  void finish() {
    if (header_.line == 0 && !diagnostics_.any()) {
      diagnostics_.add(0, 0,
                       line_number_ == 0
                           ? "is empty: write a header X_M,C,Z and rows"
                           : "has no header and no rows: write a header X_M,C,Z and rows");
    }
    const std::size_t good = stream_.size();
    csv_refuse_keys_between(keys_, good, diagnostics_);
    const bool dropped = rows_ && rows_->invalid().any() && options_.drop_invalid;
    // With an unknown column no row is kept, so that nothing tells how many have values.
    if (dropped && header_.find(CsvRole::unknown) == nullptr)
      if (const std::string many = csv_too_many_invalid(rows_->invalid().count(), good);
          !many.empty())
        diagnostics_.add(0, 0, many);
    if (header_.line != 0 && !header_.columns.empty()) {
      csv_finish(
          header_, metadata_, options_, [this](std::size_t row) { return line_of_row(row); },
          stream_, diagnostics_);
    }
    if (rows_ && !dropped)
      diagnostics_.remedy(
          rows_->invalid().remedy(of_arrays_ ? "" : stream_.source, options_, {}, good));
    diagnostics_.throw_if_any();
    if (dropped) stream_.read_as.push_back(rows_->invalid().left_out());
    if (options_.drop_invalid) leave_out_limits(stream_);
  }

 private:
  bool line(std::string_view text) {
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    if (line_number_ == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (line_number_ == 1 && (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF"))) {
      diagnostics_.add(1, 1, "this is UTF-16 text: save it as UTF-8");
      return false;
    }
    const std::string_view content = csv_without_comment(text);
    if (trimmed(content).empty()) {
      if (rows_ && text.starts_with('#') && rows_->is_row_of_no_value(text)) {
        rows_->any_row(text, line_number_);
        return true;
      }
      if (content.size() == text.size()) return true;
      metadata_.comment(text, line_number_);
      if (const std::string_view key = csv_known_key(text); !key.empty())
        keys_.push_back({line_number_, csv_character(text, key), stream_.size(), std::string(key)});
      return true;
    }
    if (content.size() < text.size()) metadata_.comment_behind(text, content.size(), line_number_);
    if (rows_) {
      rows_->any_row(content, line_number_);
      return true;
    }
    header_ = csv_parse_header(content, line_number_, diagnostics_);
    if (header_.columns.empty()) return false;
    rows_.emplace(header_, stream_, diagnostics_, options_.drop_invalid);
    return true;
  }

  /// After a line below the header: remembers one that gave no row.
  void note_without_row(std::size_t rows_before) {
    if (rows_ && line_number_ > header_.line && stream_.size() == rows_before)
      without_row_.push_back(rows_before);
  }
  std::size_t line_of_row(std::size_t row) const {
    const auto above = std::ranges::upper_bound(without_row_, row) - without_row_.begin();
    return header_.line + 1 + row + static_cast<std::size_t>(above);
  }

  ProbeStream& stream_;
  CsvDiagnostics& diagnostics_;
  CsvMetadataReader metadata_;
  const StreamReadOptions& options_;
  CsvHeader header_;
  std::optional<CsvRows> rows_;
  std::vector<CsvKeyBelow> keys_;
  std::vector<std::size_t> without_row_;  ///< lines below the header: how many rows each is after
  std::size_t line_number_ = 0;
  bool of_arrays_ = false;
};

struct HashStateDeleter {
  void operator()(XXH3_state_t* state) const { XXH3_freeState(state); }
};

/// XXH3 of the bytes as they come.
class StreamingHash {
 public:
  StreamingHash() : state_(XXH3_createState()) { XXH3_64bits_reset(state_.get()); }
  void add(const char* bytes, std::size_t count) { XXH3_64bits_update(state_.get(), bytes, count); }
  std::string text() const {
    return fmt::format("xxh3-64:{:016x}", XXH3_64bits_digest(state_.get()));
  }

 private:
  std::unique_ptr<XXH3_state_t, HashStateDeleter> state_;
};

/// Hands whole lines to `lines`; the text is never held beyond one chunk and one line.
void read_lines(ByteSource& source, LineReader& lines, StreamingHash& hash) {
  const auto room = std::make_unique_for_overwrite<char[]>(chunk_bytes + longest_line_bytes + 1);
  char* buffer = room.get();
  std::size_t kept = 0;  // start of a line whose end is not read yet
  bool reserved = false;
  while (const std::size_t got = source.read(buffer + kept, chunk_bytes)) {
    hash.add(buffer + kept, got);
    const std::size_t filled = kept + got;
    const std::size_t last = std::string_view(buffer + kept, got).rfind('\n');
    const std::size_t whole = last == std::string_view::npos ? 0 : kept + last + 1;
    if (!lines.block(buffer, buffer + whole)) return;
    kept = filled - whole;
    if (kept > longest_line_bytes) return lines.too_long();
    std::memmove(buffer, buffer + whole, kept);
    if (!reserved && whole > 0) {
      lines.reserve_for(source.size(), whole);
      reserved = true;
    }
  }
  if (kept == 0) return;
  buffer[kept] = '\n';
  lines.block(buffer, buffer + kept + 1);
}

template <class Feed>
ProbeStream read_from(const std::string& source, const StreamReadOptions& options, Feed&& feed,
                      std::function<std::size_t(std::size_t)> line_of = {}) {
  ProbeStream stream;
  stream.source = source;
  CsvDiagnostics diagnostics(source, options.max_diagnostics, std::move(line_of));
  LineReader lines(stream, diagnostics, options);
  feed(lines);
  lines.finish();
  return stream;
}

}  // namespace

ProbeStream read_stream_csv(const std::string& path, const StreamReadOptions& options) {
  ByteSource source(path);
  StreamingHash hash;
  ProbeStream stream =
      read_from(path, options, [&](LineReader& lines) { read_lines(source, lines, hash); });
  stream.input_hash = hash.text();
  return stream;
}

ProbeStream read_stream_csv_text(std::string_view text, const std::string& source,
                                 const StreamReadOptions& options) {
  ProbeStream stream = read_from(source, options, [&](LineReader& lines) {
    const std::size_t whole = text.rfind('\n') + 1;  // 0 where there is none
    if (!lines.block(text.data(), text.data() + whole) || whole == text.size()) return;
    const std::string last = std::string(text.substr(whole)) + '\n';
    lines.block(last.data(), last.data() + last.size());
  });
  stream.input_hash = content_hash(text);
  return stream;
}

ProbeStream read_stream_rows(std::string_view head, std::span<const double> numbers,
                             const std::function<std::string(std::size_t)>& text_of,
                             const std::string& source, const StreamReadOptions& options,
                             std::function<std::size_t(std::size_t)> line_of) {
  const auto feed = [&](LineReader& lines) {
    if (lines.block(head.data(), head.data() + head.size())) lines.rows(numbers, text_of);
  };
  return read_from(source, options, feed, std::move(line_of));
}

ProbeStream read_stream_columns(std::string_view head,
                                std::span<const std::span<const double>> columns,
                                const std::string& source, const StreamReadOptions& options) {
  StreamingHash hash;
  hash.add(head.data(), head.size());
  for (const std::span<const double> column : columns) {
    expects(column.size() == columns.front().size(), "columns of equal length");
    hash.add(reinterpret_cast<const char*>(column.data()), column.size_bytes());
  }
  const auto feed = [&](LineReader& lines) {
    if (lines.block(head.data(), head.data() + head.size())) lines.columns(columns);
  };
  const auto above = static_cast<std::size_t>(std::ranges::count(head, '\n'));
  const auto row_of = [above](std::size_t line) { return line > above ? line - above : 0; };
  ProbeStream stream = read_from(source, options, feed, row_of);
  stream.input_hash = hash.text();
  return stream;
}

}  // namespace trueaxis
