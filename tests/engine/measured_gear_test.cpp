// Gears with measured curves: files beside the study, whose numbers the study holds.
#include "engine/measured_gear.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "model/error.hpp"
#include "plan/phase_grid.hpp"
#include "support/folder.hpp"

namespace gearsweep::testing {
namespace {

using ::testing::HasSubstr;

double mean_stiffness(const Study& study) {
  const std::vector<double> bounds = segment_bounds(*study.model, study.setting);
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < bounds.size(); ++i) {
    constexpr int kParts = 2000;  // even
    const double inside = 0.5 * (bounds[i] + bounds[i + 1]), length = bounds[i + 1] - bounds[i];
    const MeshReader mesh(*study.model, study.setting);
    for (int part = 0; part <= kParts; ++part) {
      const double weight = part == 0 || part == kParts ? 1.0 : part % 2 == 1 ? 4.0 : 2.0;
      const double psi = part == kParts ? bounds[i + 1] : bounds[i] + length * part / kParts;
      sum += weight * length / (3.0 * kParts) * mesh.at(psi, inside).stiffness;
    }
  }
  return sum;
}

// The stiffness of the parabolic option, written anew, as a finite-element run would give it.
std::string parabolic_table(double scale) {
  constexpr double kRatio = 1.3, kFall = 0.35;
  const auto pair = [](double s) {
    const double offset = (s - kRatio / 2.0) / (kRatio / 2.0);
    return (1.0 - kFall * offset * offset) / (kRatio * (1.0 - kFall / 3.0));
  };
  std::string text = "share, N/m\n";
  const auto add = [&](double psi, double value) {
    text += fmt::format("{}, {}\n", psi, scale * value);
  };
  constexpr int kPoints = 60;
  for (int i = 0; i <= kPoints; ++i) {
    const double psi = (kRatio - 1.0) * i / kPoints;
    add(psi, pair(psi) + pair(psi + 1.0));
  }
  for (int i = 0; i <= kPoints; ++i) {
    const double psi = kRatio - 1.0 + (2.0 - kRatio) * i / kPoints;
    add(i == kPoints ? 1.0 : psi, pair(psi));
  }
  add(1.0, pair(0.0) + pair(1.0));
  return text;
}

TEST(MeasuredGear, ATableOfTheParabolicStiffnessIsTheParabolicOption) {
  const std::string keys = kOneSine + "stiffness_file = 'k.csv'\n";
  const SweepResult own = run(measured_text(kOneSine));
  for (const bool is_cubic : {true, false}) {
    const std::string bent = is_cubic ? "stiffness_interpolation = 'cubic'\n" : "";
    const SweepResult measured =
        run(measured_text(keys + bent, held_table("k.csv", parabolic_table(kMeanStiffness))));
    EXPECT_EQ(option_of(measured.study.setting, "stiffness"), "table");
    // A parabola is a cubic; between 60 points a line is off by 0.35/2 (1/60)^2 at most.
    const double tolerance = is_cubic ? 1e-10 : 1e-4;
    for (std::size_t point = 0; point < 3; ++point) {
      EXPECT_NEAR(map_of(measured, "dmf_max")[point], map_of(own, "dmf_max")[point], tolerance);
      for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(samples_of(measured, point, i)[1], samples_of(own, point, i)[1], tolerance);
      }
    }
  }
}

// Without the curve there is no force, and nothing to touch: quantities are chosen with it.
TEST(MeasuredGear, AMeasuredStiffnessThatIsNamedHasContacts) {
  const std::string tables = held_table("k.csv", "0 2.3e8\n0.7 2.3e8\n0.7 1.6e8\n");
  const Study named =
      read_study("[model]\nstiffness = 'table'\n" +
                     measured_text(kOneSine + "stiffness_file = 'k.csv'\n", tables),
                 "test.toml", {"observe.quantities=['contact_drive', 'backlash_max']"});
  EXPECT_EQ(named.selection.quantities.size(), 2U);
}

TEST(MeasuredGear, TheMeanIsKeptOrNormalised) {
  const std::string table =
      held_table("k.csv", "share, N/m\n0, 1e8\n0.4, 3e8\n0.4, 2e8\n0.8, 1.5e8\n");
  // By hand: 0.4 of mean 2e8, 0.4 of mean 1.75e8, 0.2 of mean 1.25e8.
  const double mean = 0.4 * 2e8 + 0.4 * 1.75e8 + 0.2 * 1.25e8;
  const std::string keys = kOneSine + "stiffness_file = 'k.csv'\n";
  EXPECT_NEAR(mean_stiffness(measured_study(keys, table)), mean / kMeanStiffness, 1e-9);
  EXPECT_NEAR(mean_stiffness(measured_study(keys + "stiffness_mean = 'normalise'\n", table)), 1.0,
              1e-9);
  // Nothing but the file says how stiff the mesh is.
  std::string text = measured_text(keys, table);
  const std::string given = "mesh_stiffness_N_per_m = 2.174e8\n";
  text.erase(text.find(given), given.size());
  const Study study = read_study(text, "test.toml");
  EXPECT_NEAR(study.scales.k0, mean, 1e-9 * mean);
  EXPECT_NEAR(mean_stiffness(study), 1.0, 1e-9);
  // Steps end at the jump.
  const std::vector<double> bounds = segment_bounds(*study.model, study.setting);
  const bool has_jump =
      std::ranges::any_of(bounds, [](double bound) { return std::fabs(bound - 0.4) < 1e-12; });
  EXPECT_TRUE(has_jump);
}

// Friction acts by the load of each pair: before the pitch point one way, behind it the other.
TEST(MeasuredGear, TheLoadIsSharedAsMeasured) {
  const std::string stiffness = "'k.csv' = '''\n0 2e8\n3 2e8\n'''\n";
  const std::string share = "'s.csv' = '''\n0 0.25\n3 0.25\n'''\n";
  const Study study =
      measured_study(kOneSine + "stiffness_file = 'k.csv'\nload_share_file = 's.csv'\n",
                     "[gear.tables]\n" + stiffness + share);
  // At 0.1 the last pair approaches and the one before it recedes.
  EXPECT_NEAR(mesh_of(study, 0.1).slide, 2e8 / kMeanStiffness * (0.25 - 0.75), 1e-12);
}

// As a measuring machine writes them.
std::string pitch_errors(std::size_t teeth, double last) {
  std::string text = "um\n";
  for (std::size_t i = 0; i + 1 < teeth; ++i) {
    text += fmt::format("{}\n", 3.0 * std::sin(static_cast<double>(i * i)));
  }
  return text + fmt::format("{}\n", last);
}

TEST(MeasuredGear, FilesLieBesideTheStudyAndTravelInIt) {
  const Folder folder;
  folder.write("k.csv", parabolic_table(kMeanStiffness));
  folder.write("p.csv", pitch_errors(20, 1.5));
  const std::string text =
      measured_text(kOneSine + "stiffness_file = 'k.csv'\npinion_pitch_error_file = 'p.csv'\n");
  const std::string path = (folder / "mine.toml").string();
  const Study study = read_study(text, path);
  const Study again = read_study(study.toml, "elsewhere.toml");
  EXPECT_EQ(again.toml, study.toml);
  EXPECT_EQ(parameter_of(study.setting, "cycle"), 20.0);
  for (const double psi : {0.05, 0.3, 0.77}) {
    for (const char* name : {"stiffness", "lever", "excitation", "error"}) {
      EXPECT_EQ(mesh_of(again, psi).part(name), mesh_of(study, psi).part(name)) << name;
    }
  }
  // A journal is told apart by this text.
  folder.write("p.csv", pitch_errors(20, 1.51));
  EXPECT_NE(read_study(text, path).toml, study.toml);
}

// Each tooth has its error where it enters, and what drives x1 is minus the second derivative.
TEST(MeasuredGear, PitchErrorsAreASplineOverTheTurn) {
  const Study study = measured_study(kOneSine + "gear_pitch_error_file = 'p.csv'\n",
                                     held_table("p.csv", pitch_errors(30, 1.5)));
  EXPECT_EQ(parameter_of(study.setting, "cycle"), 30.0);
  EXPECT_EQ(option_of(study.setting, "error"), "series");
  for (std::size_t tooth = 0; tooth < 30; ++tooth) {
    const double psi = static_cast<double>(tooth) / 30.0;
    const double error = tooth == 29 ? 1.5 : 3.0 * std::sin(static_cast<double>(tooth * tooth));
    EXPECT_NEAR(mesh_of(study, psi, psi + 1e-5).error, error / 50.0, 1e-12);
  }
  const double h = 1e-5;
  for (const double psi : {0.022, 0.33, 0.5, 0.91}) {
    const double angle = 30.0 * 2.0 * std::numbers::pi * h;  // omega tau
    const double second = (mesh_of(study, psi + h).error - 2.0 * mesh_of(study, psi).error +
                           mesh_of(study, psi - h).error) /
                          (angle * angle);
    EXPECT_NEAR(mesh_of(study, psi).excitation, -second, 1e-5);
  }
}

TEST(MeasuredGear, AMeasuredErrorBecomesItsHarmonics) {
  std::string numbers = "degree, um\n";
  for (int i = 0; i < 360; ++i) {
    const double angle = i * std::numbers::pi / 180.0;
    numbers += fmt::format("{}, {}\n", i,
                           4.0 + 10.0 * std::sin(angle + 0.3) + 2.0 * std::sin(2.0 * angle - 1.0));
  }
  const Study study =
      measured_study("transmission_error_file = 'e.csv'\n", held_table("e.csv", numbers));
  const auto value = [&](const char* name) { return parameter_of(study.setting, name); };
  const double near = 1e-7;  // of the spline
  EXPECT_NEAR(value("e0"), 0.2, near);
  EXPECT_NEAR(std::sin(value("e0_phase")), std::sin(0.3), near);
  EXPECT_NEAR(value("e0_2"), 0.04, near);
  EXPECT_NEAR(std::cos(value("e0_phase_2")), std::cos(1.0), 1e-6);
  EXPECT_NEAR(std::sin(value("e0_phase_2")), -std::sin(1.0), 1e-6);
  EXPECT_NEAR(value("e0_3"), 0.0, near);
  EXPECT_EQ(option_of(study.setting, "error"), "series");
}

// Those of the pairs in contact add up, by their loads. The harmonic is integrated anew, piece by
// piece.
TEST(MeasuredGear, DeviationsOfTheProfileAddToTheErrorByTheLoad) {
  // Tip relief of both gears: 12 um at the ends of contact, nothing between 0.2 and 0.8.
  const auto removed = [](double share) {
    return 60.0 * std::max({0.0, 0.2 - share, share - 0.8});
  };
  const Study study =
      measured_study("transmission_error_um = 0.0\nprofile_deviation_file = 'w.csv'\n",
                     held_table("w.csv", "share, um\n0, 12\n0.2, 0\n0.8, 0\n1, 12\n"));
  constexpr double kRatio = 1.3, kFall = 0.35;
  const auto load = [](double share) { return 1.0 - kFall * std::pow(2.0 * share - 1.0, 2); };
  const auto error = [&](double psi) {
    const double last = psi / kRatio, before = (psi + 1.0) / kRatio;
    if (before >= 1.0) return removed(last);
    return (load(last) * removed(last) + load(before) * removed(before)) /
           (load(last) + load(before));
  };
  for (const double order : {1.0, 2.0, 3.0}) {
    double sine = 0.0, cosine = 0.0;
    constexpr int kParts = 100'000;
    for (int i = 0; i < kParts; ++i) {
      const double psi = (i + 0.5) / kParts;
      const double angle = 2.0 * std::numbers::pi * order * psi;
      sine += 2.0 / kParts * error(psi) * std::sin(angle) / 50.0;
      cosine += 2.0 / kParts * error(psi) * std::cos(angle) / 50.0;
    }
    const std::string place = order == 1.0 ? "" : fmt::format("_{}", order);
    const double amplitude = parameter_of(study.setting, "e0" + place);
    const double phase = parameter_of(study.setting, "e0_phase" + place);
    EXPECT_NEAR(amplitude * std::cos(phase), sine, 1e-4);
    EXPECT_NEAR(amplitude * std::sin(phase), cosine, 1e-4);
    EXPECT_GT(amplitude, 1e-3);
  }
}

const std::vector<const char*> kSums = {"stiffness", "lever", "lever_damping", "slide",
                                        "slide_damping"};

// The slices of helical teeth stand at phases from psi - overlap to psi: all sums over the pairs
// are means of a spur gear's over these.
TEST(MeasuredGear, HelicalTeethAreTheMeanOverTheirSlices) {
  for (const double overlap : {0.3, 0.85, 1.4}) {
    Study spur = measured_study(kOneSine);
    set_parameter(&spur.setting, "approach", 0.45);
    Study helical = spur;
    set_parameter(&helical.setting, "overlap", overlap);
    for (const double psi : {0.11, 0.43, 0.92}) {
      constexpr int kSlices = 20'000;
      std::map<std::string, double> sums;
      const MeshReader slices(*spur.model, spur.setting);
      for (int i = 0; i < kSlices; ++i) {
        const double at = psi - overlap * (i + 0.5) / kSlices;
        const double share = at - std::floor(at);
        const Mesh slice = slices.at(share, share);
        for (const char* name : kSums) {
          sums[name] += slice.part(name) / kSlices;
        }
      }
      for (const char* name : kSums) {
        EXPECT_NEAR(mesh_of(helical, psi).part(name), sums[name], 1e-4)
            << name << " " << psi << " " << overlap;
      }
    }
    EXPECT_NEAR(mean_stiffness(helical), 1.0, 1e-9);
  }
  // One base pitch of overlap: as much enters as leaves.
  Study even = measured_study(kOneSine);
  set_parameter(&even.setting, "overlap", 1.0);
  for (const double psi : {0.1, 0.4, 0.8}) EXPECT_NEAR(mesh_of(even, psi).stiffness, 1.0, 1e-14);
}

TEST(MeasuredGear, HelixAngleAndFaceWidthGiveTheOverlap) {
  const std::string text =
      measured_text(kOneSine + "helix_angle_deg = 15.0\nface_width_mm = 40.0\n");
  const Study study = read_study(text, "test.toml");
  const double beta = 15.0 * std::numbers::pi / 180.0;
  EXPECT_NEAR(parameter_of(study.setting, "overlap"),
              40.0 * std::sin(beta) / (std::numbers::pi * 3.0), 1e-12);
  EXPECT_NEAR(std::tan(parameter_of(study.setting, "alpha") * std::numbers::pi / 180.0),
              std::tan(20.0 * std::numbers::pi / 180.0) / std::cos(beta), 1e-12);
}

std::string refusal_of(const std::string& keys, const std::string& tables = "") {
  try {
    run(measured_text(keys, tables));
  } catch (const InputError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(MeasuredGear, FilesThatDoNotFitAreRefused) {
  EXPECT_THAT(refusal_of(kOneSine + "stiffness_file = 'no-such.csv'\n"), HasSubstr("no-such.csv"));
  EXPECT_THAT(refusal_of(kOneSine + "stiffness_file = 3\n"), HasSubstr("name of a file"));
  EXPECT_THAT(
      refusal_of(kOneSine + "load_share_file = 'k.csv'\n", held_table("k.csv", "0 1\n3 1\n")),
      HasSubstr("load_share_file goes with stiffness_file"));
  EXPECT_THAT(
      refusal_of(kOneSine + "pinion_pitch_error_file = 'p.csv'\n", held_table("p.csv", "1\n2\n")),
      HasSubstr("has 2 numbers; it needs one for each of the 20 teeth"));
  EXPECT_THAT(
      refusal_of(kOneSine + "pinion_pitch_error_file = 'p.csv'\n", held_table("p.csv", "a\nb\n")),
      HasSubstr("the error of a tooth in um"));
  EXPECT_THAT(refusal_of("transmission_error_file = 'e.csv'\n",
                         held_table("e.csv", "0 1\n1 2\n1 3\n3 0\n")),
              HasSubstr("jumps has no second derivative"));
  EXPECT_THAT(refusal_of(kOneSine + "transmission_error_file = 'e.csv'\n",
                         held_table("e.csv", "0 1\n1 2\n3 0\n")),
              HasSubstr("keep one"));
  EXPECT_THAT(refusal_of(kOneSine + "stiffness_mean = 'kept'\n"), HasSubstr("stiffness_mean"));
  EXPECT_THAT(
      refusal_of(kOneSine + "stiffness_file = 'k.csv'\n", held_table("k.csv", "0 0\n3 0\n")),
      HasSubstr("greater than 0"));
}

TEST(MeasuredGear, StiffnessTableNeedsItsFile) {
  try {
    run("[model]\nstiffness = 'table'\n" + kMeasuredOmegas);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("stiffness_file in [gear]"));
  }
}

}  // namespace
}  // namespace gearsweep::testing
