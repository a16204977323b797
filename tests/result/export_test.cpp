// Exported maps hold the axes and the numbers exactly.
#include "result/export.hpp"

#include <gmock/gmock.h>

#include <cstring>

#include "result/example_result.hpp"
#include "result/python.hpp"

namespace gearsweep {
namespace {

using gearsweep::testing::example_result;
using gearsweep::testing::kNaN;
using gearsweep::testing::run_python;
using gearsweep::testing::spectrum_result;
using gearsweep::testing::Spoken;
using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class ExportTest : public gearsweep::testing::IoTest {
 protected:
  std::string exported(const SweepResult& result, const std::string& quantity,
                       const std::string& ending) const {
    const std::string out = in_folder("out" + ending);
    export_maps(write(result), {quantity}, out);
    return content(out);
  }
};

TEST_F(ExportTest, CsvHasOneRowPerPointAndEmptyFieldsForMissing) {
  SweepResult result = example_result(2, 3);
  result.study.axes[0].values = {0.1, 1.0 / 3.0};
  EXPECT_EQ(exported(result, "x1_rms", ".csv"),
            "omega [varpi],b [b_n],x1_rms [b_n]\n"
            "0.1,0.3,0.1\n0.3333333333333333,0.3,1.1\n"
            "0.1,0.9,10.1\n0.3333333333333333,0.9,11.1\n"
            "0.1,1.5,20.1\n0.3333333333333333,1.5,\n");
}

TEST_F(ExportTest, CsvShowsClassesAsIntegers) {
  SweepResult result = example_result(4, 0);
  result.study.axes[0].values = {0.5, 1.0, 1.5, 2.0};
  EXPECT_EQ(exported(result, "contact_class", ".csv"),
            "omega [varpi],contact_class\n0.5,0\n1,1\n1.5,2\n2,0\n");
}

TEST_F(ExportTest, CsvOfPoincareHasOneRowPerSample) {
  SweepResult result = example_result(2, 0);
  result.study.axes[0].values = {0.4, 2.0};
  const std::string csv = exported(result, "poincare", ".csv");
  EXPECT_THAT(csv, StartsWith("omega [varpi],sample,poincare_x1 [b_n],poincare_v1 [b_n varpi]\n"
                              "0.4,1,0,0.01\n"
                              "0.4,2,0.001,0.011\n"));
  EXPECT_THAT(csv, HasSubstr("\n2,5,1.004,1.014\n"));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 2 * 5);
}

TEST_F(ExportTest, CsvOfASpectrumHasAColumnPerExponent) {
  SweepResult result = spectrum_result(2, 0);
  result.study.axes[0].values = {0.4, 2.0};
  result.values[1] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, kNaN};
  const std::string csv = exported(result, "lyapunov_spectrum", ".csv");
  EXPECT_THAT(csv, StartsWith("omega [varpi],lyapunov_spectrum_1 [1/tau],lyapunov_spectrum_2 ["));
  EXPECT_THAT(csv, EndsWith(",lyapunov_spectrum_10 [1/tau]\n0.4,1,2,3,4,5,6,7,8,9,10\n"
                            "2,11,12,13,14,15,16,17,18,19,\n"));
  EXPECT_EQ(exported(result, "lyapunov_spectrum:3", ".csv"),
            "omega [varpi],lyapunov_spectrum_3 [1/tau]\n0.4,3\n2,13\n");
}

TEST_F(ExportTest, CsvHasSeveralQuantitiesBesideEachOther) {
  SweepResult result = example_result(2, 0);
  result.study.axes[0].values = {0.5, 1.0};
  const std::string path = write(result), out = in_folder("out.csv");
  export_maps(path, {"contact_class", "x1_rms"}, out);
  EXPECT_EQ(content(out), "omega [varpi],contact_class,x1_rms [b_n]\n0.5,0,0.1\n1,1,1.1\n");
  export_maps(path, {}, out);
  EXPECT_EQ(content(out),
            "omega [varpi],status,x1_rms [b_n],contact_class\n0.5,0,0.1,0\n1,0,1.1,1\n");
  EXPECT_THAT(refusal([&] {
                export_maps(path, {"x1_rms", "poincare"}, out);
              }),
              HasSubstr("-q x1_rms,poincare: poincare has one row for each sample"));
  EXPECT_THAT(refusal([&] {
                export_maps(path, {"x1_rms", "x1_rms"}, out);
              }),
              HasSubstr("'x1_rms' is listed twice"));
}

TEST_F(ExportTest, NumbersAreInUnitsOfSiWhereTheStudyHasScales) {
  SweepResult result = example_result(2, 0);
  result.study.axes[0].values = {0.5, 1.0};
  const std::string out = in_folder("out.csv");
  EXPECT_THAT(refusal([&] { export_maps(write(result), {"x1_rms"}, out, TableUnits::si); }),
              HasSubstr("a study with a [gear] table has them"));
  result.values[0] = {0.25, 2.0};
  result.study.scales = {0x1p12, 0x1p-16, 0x1p28, 1500.0};
  export_maps(write(result), {"x1_rms", "contact_class"}, out, TableUnits::si);
  EXPECT_EQ(content(out),
            "omega [rpm],x1_rms [µm],contact_class\n750,3.814697265625,0\n1500,30.517578125,1\n");
}

TEST_F(ExportTest, ReadersOfCsvTakeTheUnitsForPartOfTheNames) {
  export_maps(write(example_result()), {}, in_folder("map.csv"));
  const Spoken spoken = run_python(
      "import sys, csv\n"
      "rows = list(csv.DictReader(open(sys.argv[1])))\n"
      "assert list(rows[0])[:2] == ['omega [varpi]', 'b [b_n]'], rows[0]\n"
      "assert len(rows) == 12 and float(rows[11]['x1_rms [b_n]']) == 23.1\n",
      in_folder("map.csv"));
  EXPECT_EQ(spoken.status, 0) << spoken.text;
}

// The header's text and the numbers behind it.
struct Npy {
  std::string header;
  std::vector<double> numbers;
};

Npy parse(const std::string& bytes) {
  const std::size_t length =
      static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
  Npy npy;
  npy.header = bytes.substr(10, length);
  npy.numbers.resize((bytes.size() - 10 - length) / sizeof(double));
  std::memcpy(npy.numbers.data(), bytes.data() + 10 + length, npy.numbers.size() * sizeof(double));
  return npy;
}

TEST_F(ExportTest, NpyIsAnArrayOfRecordsWithAxesAndQuantity) {
  const std::string bytes = exported(example_result(), "x1_rms", ".npy");
  EXPECT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
  const Npy npy = parse(bytes);
  EXPECT_EQ((10 + npy.header.size()) % 64, 0U);
  EXPECT_THAT(npy.header,
              StartsWith("{'descr': [('omega', '<f8'), ('b', '<f8'), ('x1_rms', '<f8')], "
                         "'fortran_order': False, 'shape': (3, 4, ), }"));
  ASSERT_EQ(npy.numbers.size(), 12U * 3U);
  const std::size_t last = 11 * 3;
  EXPECT_EQ(npy.numbers[last], 2.0);
  EXPECT_EQ(npy.numbers[last + 1], 1.5);
  EXPECT_EQ(npy.numbers[last + 2], 23.1);
  EXPECT_TRUE(std::isnan(npy.numbers[5 * 3 + 2]));
}

TEST_F(ExportTest, NpyOfPoincareHasAFieldOfStatesAndSamples) {
  const Npy npy = parse(exported(example_result(4, 0), "poincare", ".npy"));
  EXPECT_THAT(npy.header, AllOf(HasSubstr("('poincare', '<f8', (2, 5))"), HasSubstr("(4, )")));
  ASSERT_EQ(npy.numbers.size(), 4U * (1 + 10));
  EXPECT_EQ(npy.numbers[3 * 11], 2.0);
  EXPECT_EQ(npy.numbers[3 * 11 + 1 + 5 + 4], example_result(4, 0).samples[3 * 10 + 5 + 4]);
}

TEST_F(ExportTest, NpyOfASpectrumHasAFieldOfExponents) {
  const SweepResult result = spectrum_result();
  const Npy npy = parse(exported(result, "lyapunov_spectrum", ".npy"));
  EXPECT_THAT(npy.header, HasSubstr("('lyapunov_spectrum', '<f8', (10,))"));
  ASSERT_EQ(npy.numbers.size(), 12U * (2 + 10));
  EXPECT_EQ(npy.numbers[11 * 12 + 2 + 9], result.values[1][11 * 10 + 9]);
}

TEST_F(ExportTest, NpyHasAFieldForEachQuantity) {
  const std::string path = write(example_result()), out = in_folder("out.npy");
  export_maps(path, {"x1_rms", "poincare", "contact_class"}, out);
  const Npy npy = parse(content(out));
  EXPECT_THAT(npy.header, HasSubstr("('x1_rms', '<f8'), ('poincare', '<f8', (2, 5)), "
                                    "('contact_class', '<f8')], "));
  ASSERT_EQ(npy.numbers.size(), 12U * (2 + 1 + 10 + 1));
  EXPECT_EQ(npy.numbers[14 + 2], 1.1);
  EXPECT_EQ(npy.numbers[14 + 13], 1.0);
  EXPECT_THAT(refusal([&] {
                export_maps(path, {"poincare:x1", "poincare:v1"}, out);
              }),
              HasSubstr("'poincare' is listed twice"));
}

TEST_F(ExportTest, NumPyOpensIt) {
  const std::string path = write(example_result());
  export_maps(path, {"x1_rms"}, in_folder("map.npy"));
  export_maps(path, {"poincare"}, in_folder("samples.npy"));
  const Spoken map = run_python(
      "import sys, numpy as np\n"
      "m = np.load(sys.argv[1])\n"
      "assert m.shape == (3, 4) and m.dtype.names == ('omega', 'b', 'x1_rms'), m.dtype\n"
      "assert m['x1_rms'][2, 3] == 23.1 and m['omega'][0, 3] == 2.0 and m['b'][2, 0] == 1.5\n"
      "assert np.isnan(m['x1_rms'][1, 1])\n",
      in_folder("map.npy"));
  EXPECT_EQ(map.status, 0) << map.text;
  const Spoken samples = run_python(
      "import sys, numpy as np\n"
      "assert np.load(sys.argv[1])['poincare'].shape == (3, 4, 2, 5)\n",
      in_folder("samples.npy"));
  EXPECT_EQ(samples.status, 0) << samples.text;
  export_maps(write(spectrum_result()), {"lyapunov_spectrum"}, in_folder("spectrum.npy"));
  const Spoken spectrum = run_python(
      "import sys, numpy as np\n"
      "s = np.load(sys.argv[1])['lyapunov_spectrum']\n"
      "assert s.shape == (3, 4, 10) and s[0, 0, 0] == 0.3 - 0.1 and np.isnan(s[1, 1]).all()\n",
      in_folder("spectrum.npy"));
  EXPECT_EQ(spectrum.status, 0) << spectrum.text;
}

TEST_F(ExportTest, WhatCannotBeExportedIsRefusedAndLeavesNoFile) {
  const std::string path = write(example_result());
  EXPECT_THAT(refusal([&] { export_maps(path, {"x1_rms"}, in_folder("out.txt")); }),
              AllOf(HasSubstr("out.txt"), HasSubstr(".csv or .npy")));
  EXPECT_THAT(refusal([&] { export_maps(path, {"x1_rsm"}, in_folder("out.csv")); }),
              HasSubstr("did you mean 'x1_rms'?"));
  EXPECT_THAT(refusal([&] { export_maps(path, {"x1_rms"}, in_folder("missing/out.csv")); }),
              HasSubstr("there is no folder"));
  EXPECT_EQ(files(), 1U);
}

}  // namespace
}  // namespace gearsweep
