// SPDX-License-Identifier: Apache-2.0
#include "study/sweep/files/sweep_toml.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include "base/diagnostics.hpp"
#include "format/file.hpp"
#include "simulate/files/scenario_files.hpp"
#include "study/sweep/files/sweep_axes.hpp"
#include "trueaxis/error.hpp"

namespace trueaxis {
namespace {

using namespace study;

constexpr long long most_repeats = 100'000'000;

std::vector<Method> read_methods(TomlTable root) {
  std::vector<Method> methods;
  for (const std::string& word : root.texts("methods")) {
    const Method all[] = {Method::fit, Method::huber, Method::tukey, Method::diagnosis};
    const auto* known =
        std::ranges::find_if(all, [&](Method method) { return word == to_string(method); });
    if (known == std::end(all)) {
      root.complain("methods", "names \"" + word + "\": known are fit, huber, tukey, diagnosis");
    } else if (std::ranges::find(methods, *known) != methods.end()) {
      root.complain("methods", "names \"" + word + "\" twice");
    } else {
      methods.push_back(*known);
    }
  }
  if (methods.empty()) methods.push_back(Method::fit);
  return methods;
}

/// "section" where the sweep wants a circle and not the surface of the part.
std::string read_surface(TomlTable root, const virtual_lathe::Scenario& base) {
  const bool section = root.choice("surface", {{"part", false}, {"section", true}}, false);
  if (section && base.part.kind == virtual_lathe::PartKind::face)
    root.complain("surface",
                  "is \"section\", but a face is probed across: give a cone or cylinder");
  return section ? "section" : "";
}

/// The pass band of the roundness that is compared as well.
std::optional<std::array<double, 2>> read_form_band(TomlTable root,
                                                    const virtual_lathe::Scenario& base) {
  if (!root.has("form_upr")) return {};
  const std::vector<double> band = root.numbers("form_upr");
  if (base.part.kind == virtual_lathe::PartKind::face)
    root.complain("form_upr", "is of a cone or cylinder: a face has no roundness");
  if (band.size() == 2 && band[0] >= 1.0 && band[1] > band[0] && band[1] <= 500.0)
    return std::array{band[0], band[1]};
  root.complain("form_upr",
                "is the pass band in undulations per revolution: [1, 15], [1, 50], [1, 150], "
                "[1, 500] or another");
  return {};
}

/// The scenario of the file or of the sweep's own tables, and its bytes for the hash.
std::string read_base(TomlDocument& document, TomlTable root, study::Sweep& sweep) {
  if (!root.has("scenario")) {
    read_scenario_tables(root, sweep.base);
    return {};
  }
  const std::string path = root.required_path("scenario");
  if (path.empty()) return {};
  sweep.input_files.push_back(path);
  std::string content;
  try {
    content = read_file(path);
  } catch (const InputError& error) {
    root.complain("scenario", std::string("cannot be used: ") + error.what());
    return {};
  }
  const bool good = gather(document, [&] { sweep.base = parse_scenario_toml(content, path); });
  return good ? content : std::string();
}

/// The table of every repeat is that of its own fit, and the cut lies next to the surface probed.
void check_cut(TomlDocument& document, const std::string& path, const Sweep& sweep) {
  const virtual_lathe::CutProgram& cut = *sweep.base.cut;
  const auto complain = [&](const char* what) { document.add({path, 0, 0, what}); };
  if (!cut.table.empty())
    complain("[cut] table: a sweep makes the table of every repeat itself: remove `table`");
  if (cut.target.kind == virtual_lathe::CutKind::face)
    complain("[cut.target] kind: a sweep cuts a cylinder or a cone");
  if (sweep.base.part.kind == virtual_lathe::PartKind::face || !sweep.surface.empty())
    complain("[cut] needs an axis with a direction: probe a cone or cylinder, and leave `surface`");
}

}  // namespace

study::Sweep parse_sweep_toml(std::string_view content, const std::string& path,
                              const std::vector<SweepExtension>& extensions) {
  TomlDocument document(content, path);
  TomlTable root = document.root();
  Sweep sweep;
  sweep.input_files = {path};
  const std::string scenario = read_base(document, root, sweep);
  const SweepAxes axes(document, root, sweep);
  sweep.name = root.text("name");
  sweep.seed =
      static_cast<std::uint64_t>(root.integer("seed", 1, 0, std::numeric_limits<long long>::max()));
  sweep.repeats = static_cast<std::size_t>(root.integer("repeats", 2000, 1, most_repeats));
  sweep.methods = read_methods(root);
  sweep.form_upr = read_form_band(root, sweep.base);
  sweep.surface = read_surface(root, sweep.base);
  sweep.input_hash = content_hash(std::string(content) + '\0' + scenario);
  if (sweep.base.cut) check_cut(document, path, sweep);
  const ReadSet read_set = [&](const TomlTable& set) { return axes.read_set_before_axes(set); };
  for (const SweepExtension& extension : extensions) {
    std::optional<TomlTable> table = root.maybe_table(extension.key);
    if (!table) continue;
    if (document.ok()) {
      extension.read(*table, sweep, read_set);
    } else {
      table->ignore_rest();
    }
  }
  document.finish();
  return sweep;
}

}  // namespace trueaxis
