// SPDX-License-Identifier: Apache-2.0
// Laws of the catalogue as a table, and of its terms without any geometry behind them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "effect/linear_count.hpp"
#include "trueaxis/effect.hpp"
#include "trueaxis/error.hpp"
#include "trueaxis/virtual_lathe.hpp"

namespace trueaxis {
namespace {

TEST(EffectLaws, IdsAreThoseOfTheVirtualLathe) {
  // Noise of these kinds has its own table in a scenario; what no catalogue has is `extra.`.
  // A stated noise is a word of the stream, not of the lathe.
  std::set<std::string> lathe{"probe.incidence_noise", "probe.correlated_noise", "probe.outliers",
                              "probe.stated_noise"};
  for (const virtual_lathe::EffectKind& kind : virtual_lathe::effect_kinds()) {
    if (!kind.id.starts_with("extra.")) lathe.insert(std::string(kind.id));
  }
  std::set<std::string> catalogue;
  for (const Effect& effect : effect_catalogue()) {
    EXPECT_TRUE(catalogue.insert(std::string(effect.id)).second) << effect.id << " twice";
    EXPECT_EQ(find_effect(effect.id), &effect);
  }
  EXPECT_EQ(catalogue, lathe);
  EXPECT_EQ(find_effect("part.nothing"), nullptr);
}

TEST(EffectLaws, EntriesExplainThemselves) {
  const std::set<std::string_view> units{"mm", "rad", "s", "Hz", "1", "mm/s"};
  const std::set<std::string_view> families{"part",    "spindle", "slide",      "probe",
                                            "encoder", "thermal", "environment"};
  for (const Effect& effect : effect_catalogue()) {
    SCOPED_TRACE(effect.id);
    EXPECT_TRUE(families.contains(effect.id.substr(0, effect.id.find('.'))));
    for (const std::string_view text :
         {effect.title, effect.formula, effect.signature, effect.consequence, effect.source}) {
      EXPECT_FALSE(text.empty());
    }
    EXPECT_FALSE(effect.parameters.empty());
    std::set<std::string_view> names;
    for (const EffectParameter& parameter : effect.parameters) {
      EXPECT_TRUE(names.insert(parameter.name).second) << parameter.name << " twice";
      EXPECT_TRUE(units.contains(parameter.unit)) << parameter.unit;
      EXPECT_LE(parameter.low, parameter.high) << parameter.name;
      EXPECT_FALSE(parameter.meaning.empty()) << parameter.name;
    }
    EXPECT_EQ(std::holds_alternative<std::monostate>(effect.term), effect.check.has_value());
    EXPECT_EQ(effect.confounders.empty(), effect.check.has_value());
    EXPECT_EQ(effect.separations.empty(), effect.check.has_value());
    if (!effect.check) {
      EXPECT_NE(effect.slot, Slot::noise);
    }
  }
}

TEST(EffectLaws, ConfusionIsMutualAndNeverWithACheck) {
  for (const Effect& effect : effect_catalogue()) {
    for (const std::string_view id : effect.confounders) {
      const Effect* other = find_effect(id);
      ASSERT_NE(other, nullptr) << effect.id << " names " << id;
      EXPECT_NE(other, &effect);
      EXPECT_FALSE(other->check || effect.check) << effect.id << ", " << id;
      EXPECT_EQ(std::count(other->confounders.begin(), other->confounders.end(), effect.id), 1)
          << id << " does not name " << effect.id;
    }
  }
}

TEST(EffectLaws, AConfusionIsStatedOnceAndKnownToBoth) {
  const std::vector<Effect> list = with_mutual_confounders({
      {.id = "a.first"},
      {.id = "a.second", .confounders = {"a.first"}},
      {.id = "a.third", .confounders = {"a.second", "a.first"}},
  });
  using Ids = std::vector<std::string_view>;
  EXPECT_EQ(list[0].confounders, (Ids{"a.second", "a.third"}));
  EXPECT_EQ(list[1].confounders, (Ids{"a.first", "a.third"}));
  EXPECT_EQ(list[2].confounders, (Ids{"a.first", "a.second"}));
  EXPECT_THROW(with_mutual_confounders({{.id = "a.first", .confounders = {"a.frist"}}}),
               ContractViolation);
}

TEST(EffectLaws, ChecksAndOwnEffectsAreFoundToo) {
  for (const Effect& effect : effect_catalogue()) {
    if (effect.check) {
      EXPECT_EQ(&entry_of(*effect.check), &effect);
    }
  }
  const Effect own{.id = "own.form"};
  EXPECT_EQ(find_effect(own.id), nullptr);
  EXPECT_EQ(find_effect(own.id, {&own, 1}), &own);
  EXPECT_EQ(find_effect("part.bow", {&own, 1}), find_effect("part.bow"));
}

// What the virtual lathe has apart is known by its name; a law of the lathe plays every entry.
TEST(EffectLaws, NamesInTheLatheAreOfWhatBothHave) {
  for (const Effect& effect : effect_catalogue()) {
    SCOPED_TRACE(effect.id);
    for (const NameInLathe& name : effect.names_in_lathe) {
      const auto& parameters = virtual_lathe::find_effect_kind(effect.id).parameters;
      EXPECT_TRUE(std::ranges::any_of(parameters, [&](const auto& p) {
        return p.name.starts_with(std::string(name.in_lathe) + "_") || p.name == name.in_lathe;
      })) << name.in_lathe;
    }
    const auto* harmonic = std::get_if<Harmonic>(&effect.term);
    const bool lever = harmonic && harmonic->envelope == Harmonic::Envelope::lever;
    ASSERT_EQ(lever, !effect.motion_beside.empty());
    if (lever) {
      EXPECT_NO_THROW(virtual_lathe::find_effect_kind(effect.motion_beside));
    }
  }
}

// What a diagnosis does with an entry is about parameters that its term has.
TEST(EffectLaws, SearchesFitTheirTerms) {
  std::size_t causes = 0;
  for (const Effect& effect : effect_catalogue()) {
    if (effect.check) continue;
    ++causes;
    SCOPED_TRACE(effect.id);
    TermShape shape;
    shape.degree = std::max(shape.degree, effect.search.highest_degree);
    const auto linear = linear_parameters(effect.term, shape);
    const auto names = shape_parameters(effect.term);
    for (const EffectParameter& p : effect.parameters) {
      const bool told = p.of.empty() || std::ranges::count(names, p.of) == 1 ||
                        std::ranges::count(linear, p.of, &LinearParameter::name) == 1;
      EXPECT_TRUE(told) << p.name << " of " << p.of;
    }
    // Another value of a parameter that the term reads is known by its name.
    const auto reads = [&](double TermShape::*parameter) {
      TermShape other = shape;
      other.*parameter += 1.0;
      return std::ranges::any_of(names, [&](const std::string& name) {
        return shape_value(shape, name) != shape_value(other, name);
      });
    };
    for (const ShapeValues& v : effect.typical) {
      EXPECT_TRUE(reads(v.parameter));
      EXPECT_FALSE(v.values.empty());
    }
    ASSERT_FALSE(effect.search.forms.empty());
    for (const SearchForm& form : effect.search.forms) {
      for (const std::size_t j : form.free) EXPECT_LT(j, linear.size());
      EXPECT_EQ(form.starts.parameter == nullptr, form.starts.values.empty());
      if (!form.starts.parameter) continue;
      EXPECT_TRUE(reads(form.starts.parameter));
      EXPECT_LT(form.starts.alone, form.starts.values.size());
    }
    if (effect.refinement) {
      EXPECT_TRUE(reads(effect.refinement->parameter));
    }
    if (effect.line) {
      EXPECT_LT(effect.line->low, effect.line->high);
    }
    const std::string_view twin = effect.second_order_twin;
    if (!twin.empty()) {
      ASSERT_NE(find_effect(twin), nullptr);
      EXPECT_EQ(find_effect(twin)->second_order_twin, effect.id);
    }
  }
  EXPECT_EQ(causes + 7, effect_catalogue().size());  // as many checks as DataCheck has
}

TEST(EffectLaws, SeparatorsAreKnownAndAllUsed) {
  std::set<std::string_view> known, used;
  for (const Separator& separator : separators()) {
    EXPECT_FALSE(separator.what.empty());
    EXPECT_TRUE(known.insert(separator.code).second);
  }
  EXPECT_EQ(known, (std::set<std::string_view>{"RV", "RZ", "2W", "DW", "ST", "RC", "RE", "MS", "OZ",
                                               "RM", "XJ"}));
  for (const Effect& effect : effect_catalogue()) {
    std::set<std::string_view> own;
    for (const Separation& separation : effect.separations) {
      EXPECT_TRUE(known.contains(separation.code)) << effect.id << ": " << separation.code;
      EXPECT_TRUE(own.insert(separation.code).second) << effect.id << ": " << separation.code;
      EXPECT_FALSE(separation.how.empty());
    }
    used.insert(own.begin(), own.end());
  }
  EXPECT_EQ(used, known);
}

TEST(EffectLaws, MisspeltIdsFindTheirNeighbour) {
  EXPECT_EQ(nearest_effects("part.bwo").front(), "part.bow");
  EXPECT_EQ(nearest_effects("backlash").front(), "slide.backlash");
  EXPECT_EQ(nearest_effects("spindle.roundness").front(), "part.roundness");
  EXPECT_EQ(nearest_effects("part.bow", 2).size(), 2u);
}

// Two readings of a centred cylinder, R = 40: every number of the terms is known beforehand.
struct Bench {
  std::vector<double> c{0.0, 1.0}, z{-10.0, 10.0}, t{0.0, 2.0}, speed{6.0, 6.0}, v{1.0, -1.0};
  std::vector<double> x{40.0, 40.0}, flat{0.0, 0.0}, one{1.0, 1.0};

  TermContext context() const {
    TermContext at;
    at.c_rad = at.theta_rad = at.theta_chuck_rad = c;
    at.z_mm = at.s_mm = z;
    at.time_s = t;
    at.speed_rad_per_s = speed;
    at.velocity_mm_per_s = v;
    at.x_mm = at.sensed_mm = x;
    at.dx_dc = at.dx_dz = at.d2x_dc2 = flat;
    at.clamp_force_ratio = one;
    at.z_half_mm = 10.0;
    return at;
  }
};

std::vector<std::vector<double>> columns_of(const EffectTerm& term, const TermContext& at,
                                            const TermShape& shape) {
  std::vector<std::vector<double>> columns(linear_parameters(term, shape).size(),
                                           std::vector<double>(at.size()));
  std::vector<double*> rows;
  for (auto& column : columns) rows.push_back(column.data());
  fill_columns(term, at, shape, rows);
  return columns;
}

TEST(EffectLaws, CountsItsLinearParameters) {
  for (const Effect& effect : effect_catalogue()) {
    for (const int degree : {0, 2, 5}) {
      TermShape shape;
      shape.degree = degree;
      EXPECT_EQ(linear_count(effect.term, shape), linear_parameters(effect.term, shape).size())
          << effect.id << ' ' << degree;
    }
  }
}

TEST(EffectLaws, ACentredCylinderShowsOnlyWhatItCan) {
  const Bench bench;
  TermShape shape;
  shape.order = 3.0;
  shape.reference_x_mm = 40.0;
  // Without slopes an argument, a height or a tilt changes nothing; forms are read as they are.
  for (const char* id : {"encoder.offset", "encoder.eccentricity", "probe.latency", "probe.lag",
                         "probe.height", "probe.tilt", "probe.gain", "probe.nonlinearity",
                         "spindle.axial_synchronous", "slide.leadscrew_periodic"}) {
    for (const auto& column : columns_of(find_effect(id)->term, bench.context(), shape)) {
      EXPECT_EQ(column, (std::vector<double>{0.0, 0.0})) << id;
    }
  }
  const auto lobes = columns_of(find_effect("part.roundness")->term, bench.context(), shape);
  ASSERT_EQ(lobes.size(), 4u);
  EXPECT_DOUBLE_EQ(lobes[0][1], std::cos(3.0));
  EXPECT_DOUBLE_EQ(lobes[1][1], std::sin(3.0));
  EXPECT_DOUBLE_EQ(lobes[2][0], -1.0);  // u = −1, θ = 0
  const auto barrel = columns_of(find_effect("part.barrel")->term, bench.context(), shape);
  ASSERT_EQ(barrel.size(), 2u);
  EXPECT_DOUBLE_EQ(barrel[0][0], 1.0);   // P2(−1)
  EXPECT_DOUBLE_EQ(barrel[1][0], -1.0);  // P3(−1)
}

TEST(EffectLaws, RearAndBoreTurnTheSignsOfFormAndBall) {
  const Bench bench;
  for (const bool rear : {false, true}) {
    for (const bool bore : {false, true}) {
      TermContext at = bench.context();
      at.rear = rear;
      at.bore = bore;
      const double form = columns_of(find_effect("part.taper")->term, at, {})[0][1];
      const double ball = columns_of(find_effect("probe.ball_radius")->term, at, {})[0][1];
      EXPECT_EQ(form, rear ? -1.0 : 1.0);
      EXPECT_EQ(ball, rear == bore ? 1.0 : -1.0);
    }
  }
}

TEST(EffectLaws, AMissingColumnIsABrokenContract) {
  const Bench bench;
  TermContext at = bench.context();
  at.time_s = {};
  std::vector<double> column(2);
  double* const out[] = {column.data()};
  const EffectTerm offset = find_effect("encoder.offset")->term;
  EXPECT_THROW(fill_columns(offset, at, {}, out), ContractViolation);
  at = bench.context();
  EXPECT_NO_THROW(fill_columns(offset, at, {}, out));
  EXPECT_THROW(fill_columns(offset, at, {}, {}), ContractViolation);
  at.d2x_dc2 = {};
  EXPECT_NO_THROW(fill_columns(offset, at, {}, out));
  EXPECT_THROW(fill_columns(find_effect("probe.lag")->term, at, {}, out), ContractViolation);
}

}  // namespace
}  // namespace trueaxis
