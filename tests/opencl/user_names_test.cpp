// A user may call states, parameters, signals, constants, options and choices what C, OpenCL C and
// the kernels call something else.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "expression/expression.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "opencl/detail/kernel_sources.hpp"
#include "opencl/detail/program.hpp"
#include "opencl/device.hpp"
#include "study/study.hpp"

namespace gearsweep::testing {
namespace {

constexpr std::size_t kOfEach = 60;  // names of a role in one model

const std::regex& identifier() {
  static const std::regex kIdentifier("[A-Za-z_][A-Za-z_0-9]*");
  return kIdentifier;
}

std::set<std::string> identifiers_of(const std::string& text) {
  std::set<std::string> found;
  for (std::sregex_iterator word(text.begin(), text.end(), identifier()), end; word != end;
       ++word) {
    found.insert(word->str());
  }
  return found;
}

// Words of C, C++ and OpenCL C and common macros first; then all that the kernels have.
std::vector<std::string> words() {
  std::vector<std::string> words = split_words(
      "inside scale X NULL true false TABLE LANES M_PI M_E INFINITY NAN HUGE_VAL MAXFLOAT FLT_MAX "
      "DBL_EPSILON INT_MAX CHAR_BIT EOF errno assert offsetof complex I bool auto break case char "
      "const continue default do double else enum extern float for goto half inline int long "
      "register restrict return short signed sizeof static struct switch typedef union unsigned "
      "void volatile while global local constant private kernel uniform pipe generic read_only "
      "write_only read_write image2d_t sampler_t event_t queue_t uchar ushort uint ulong size_t "
      "ptrdiff_t intptr_t double2 double4 double8 double16 float4 float8 long8 int4 char16 half8 "
      "class namespace template typename this new delete operator public protected virtual friend "
      "using throw try catch export mutable explicit constexpr nullptr decltype noexcept alignas "
      "asm typeof thread_local xor bitand bitor compl and_eq or_eq xor_eq not_eq concept requires "
      "co_await linux unix i386 __ fma mad select any all dot cross length normalize distance "
      "get_global_id get_local_size barrier convert_double8 as_long8 vload8 vstore8 shuffle "
      "printf prefetch exp2 pow pown powr rsqrt rint round fmin fmax hypot cbrt erf tgamma sincos "
      "fract frexp ldexp modf nan nextafter remquo degrees radians mix smoothstep isnan signbit "
      "main std cl lambda None def t tau e j0 y1");
  std::set<std::string> known(words.begin(), words.end());
  for (const auto& [file, text] : kernel_sources()) {
    for (const std::string& word : identifiers_of(text)) {
      if (known.insert(word).second) words.push_back(word);
    }
  }
  const std::set<std::string> meant = {"and",  "or",    "not",    "phase",      "pi", "clamp",
                                       "step", "table", "status", "deflection", "__"};
  std::erase_if(words, [&](const std::string& word) {
    const bool is_function = std::ranges::any_of(
        functions(), [&](const FunctionInfo& function) { return function.name == word; });
    return is_function || meant.contains(word) || word.front() == '_' || word.size() > 40;
  });
  return words;
}

// With 60 names of each role, from one place in the list on.
std::string model_of(const std::vector<std::string>& names, std::size_t from) {
  const auto name = [&](std::size_t i) { return names[(from + i) % names.size()]; };
  std::string states, parameters, constants, equations, signals, options;
  for (std::size_t i = 0; i < kOfEach; ++i) {
    const std::string state = name(i), parameter = name(kOfEach + i);
    const std::string constant = name(2 * kOfEach + i), option = name(4 * kOfEach + i);
    const bool is_angle = i == 7;
    const std::string value = is_angle ? fmt::format("sin({})", state) : state;
    states += fmt::format("{} = {{ unit = '1', angle = {} }}\n", state, is_angle);
    parameters += fmt::format("{} = 0.5\n", parameter);
    constants += fmt::format("{} = \"{}*{} + sin({}*phase)\"\n", constant, parameter, value, i + 1);
    const std::string choice = name(5 * kOfEach + i);
    options += fmt::format("{} = {{ choices = ['{}', 'another_choice'] }}\n", option, choice);
    const std::string force = i == 3 ? fmt::format("stop({}, 0.1)", state) : value;
    equations += fmt::format("{} = \"if({}.{}, -{}, {}*{})\"\n", state, option, choice, force,
                             parameter, constant);
    signals +=
        fmt::format("{} = \"{}*{} - {}\"\n", name(3 * kOfEach + i), parameter, constant, state);
  }
  return "[model]\nname = 'named'\n[states]\n" + states + "[parameters]\n" + parameters +
         "[options]\n" + options + "[constants]\n" + constants + "[equations]\n" + equations +
         "[signals]\n" + signals + "[forcing]\nperiod = '2*pi'\n";
}

Study study_of(const std::vector<std::string>& names, std::size_t from) {
  const auto name = [&](std::size_t i) { return names[(from + i) % names.size()]; };
  return read_study("[model]\ntext = '''\n" + model_of(names, from) + "'''\n[[axes]]\nname = '" +
                        name(kOfEach) + "'\nvalues = [1.0, 2.0]\n[observe]\nquantities = ['" +
                        name(0) + "_mean', '" + name(3 * kOfEach) + "_max', '" + name(5) +
                        "_rms', 'contact_class']\npoincare = ['" + name(1) + "']\n",
                    "test.toml");
}

std::vector<std::string> plain_names(std::size_t count) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < count; ++i) names.push_back(fmt::format("name{}", i));
  return names;
}

std::string without_comments(const std::string& text) {
  return std::regex_replace(text, std::regex("//[^\n]*"), "");
}

TEST(UserNames, BeginAsNothingElseInTheKernels) {
  for (const auto& [file, text] : kernel_sources()) {
    for (const std::string& word : identifiers_of(text)) {
      EXPECT_FALSE(word.starts_with(kernel_name(""))) << file << ": " << word;
      EXPECT_FALSE(word.starts_with("STATE_" + kernel_name(""))) << file << ": " << word;
    }
  }
}

// The program of a model with these names in every role is that of the same model with plain names,
// name by name. So no name can meet another meaning.
TEST(UserNames, ChangeNothingButThemselvesInAProgram) {
  const std::vector<std::string> names = words(), plain = plain_names(6 * kOfEach);
  ASSERT_GT(names.size(), 6 * kOfEach);
  const std::string expected = without_comments(study_of(plain, 0).model->kernel);
  for (std::size_t from = 0; from < names.size(); from += kOfEach) {
    std::map<std::string, std::string> back;
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const std::string& name = names[(from + i) % names.size()];
      back[kernel_name(name)] = kernel_name(plain[i]);
      back["STATE_" + kernel_name(name)] = "STATE_" + kernel_name(plain[i]);
    }
    const std::string text = without_comments(study_of(names, from).model->kernel);
    std::string renamed;
    auto at = text.begin();
    for (std::sregex_iterator word(text.begin(), text.end(), identifier()), end; word != end;
         ++word) {
      renamed.append(at, (*word)[0].first);
      const auto known = back.find(word->str());
      renamed += known == back.end() ? word->str() : known->second;
      at = (*word)[0].second;
    }
    renamed.append(at, text.end());
    ASSERT_EQ(renamed, expected) << from;
  }
}

TEST(UserNames, CompileInEveryRole) {
  const cl::Device device = find_devices().at(default_device(list_devices()));
  const cl::Context context(device);
  const Study study = study_of(words(), 0);
  EXPECT_NO_THROW(
      build_program(context, device, program_source(study, "sweep.cl"), build_options(study, 1)));
}

}  // namespace
}  // namespace gearsweep::testing
