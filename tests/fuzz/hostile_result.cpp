// Sound NetCDF files that are not quite ours: the bytes are edits of a good file.
#include <fmt/format.h>
#include <netcdf.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <utility>
#include <variant>
#include <vector>

#include "fuzz/read_all.hpp"
#include "fuzz/targets.hpp"
#include "result/output_file.hpp"

namespace gearsweep::testing {
namespace {

using Value = std::variant<std::string, std::vector<double>>;

struct Attribute {
  std::string name;
  Value value;
};

struct Variable {
  std::string name;
  nc_type type = NC_DOUBLE;
  std::vector<std::size_t> dimensions;
  std::vector<Attribute> attributes;
  std::vector<double> numbers;  // its first values; the rest count up
  std::string text;             // of a character variable
};

struct Dimension {
  std::string name;
  std::size_t size = 0;
};

struct File {
  std::vector<Dimension> dimensions;
  std::vector<Variable> variables;  // the first stands for the file: only its attributes count
};

File good_map() {
  File file;
  file.dimensions = {{"omega", 3},  {"b", 2},        {"state", 2},
                     {"sample", 4}, {"exponent", 2}, {"width", 8}};
  file.variables = {
      {"", NC_DOUBLE, {}, {{"title", "a map"}, {"study", "title = 'a'"}}, {}, ""},
      {"omega", NC_DOUBLE, {0}, {{"units", "varpi"}, {"long_name", "mesh frequency"}}, {}, ""},
      {"b", NC_DOUBLE, {1}, {{"units", "b_n"}, {"scale", "log"}}, {1.0, 2.0}, ""},
      {"status",
       NC_BYTE,
       {1, 0},
       {{"flag_values", std::vector<double>{0, 1}}, {"flag_meanings", "ok diverged"}},
       {0, 1, 0, 0, 0, 0},
       ""},
      {"x1_rms", NC_FLOAT, {1, 0}, {{"units", "b_n"}}, {}, ""},
      {"contact_class",
       NC_BYTE,
       {1, 0},
       {{"flag_values", std::vector<double>{0, 1}},
        {"flag_meanings", "single double"},
        {"_FillValue", std::vector<double>{-1}}},
       {0, 1, -1, 1, 0, 0},
       ""},
      {"lyapunov_spectrum", NC_DOUBLE, {1, 0, 4}, {{"units", "1/tau"}}, {}, ""},
      {"poincare", NC_DOUBLE, {1, 0, 2, 3}, {}, {}, ""},
      {"state", NC_CHAR, {2, 5}, {}, {}, "x1      v1      "},
      {"state_units", NC_CHAR, {2, 5}, {}, {}, "b_n     1       "},
      {"state_long_name", NC_CHAR, {2, 5}, {}, {}, "place   speed   "}};
  return file;
}

File good_traces() {
  File file;
  file.dimensions = {{"trace", 2}, {"moment", 9}, {"label_width", 8}};
  file.variables = {
      {"", NC_DOUBLE, {}, {{"content", "traces of gearsweep"}, {"title", "two"}}, {}, ""},
      {"label", NC_CHAR, {0, 2}, {}, {}, "omega=1 omega=2 "},
      {"period", NC_DOUBLE, {0}, {}, {4.0, 2.0}, ""},
      {"tau", NC_DOUBLE, {0, 1}, {{"units", "1/varpi"}}, {}, ""},
      {"x1", NC_DOUBLE, {0, 1}, {{"units", "b_n"}, {"long_name", "place"}}, {}, ""},
      {"v1", NC_DOUBLE, {0, 1}, {{"units", "b_n varpi"}}, {}, ""},
      {"dmf", NC_DOUBLE, {0, 1}, {}, {}, ""},
      {"contact", NC_DOUBLE, {0, 1}, {}, {0, 1, -1, 0, 1, 1, 0}, ""}};
  return file;
}

File good_orders() {
  File file;
  file.dimensions = {{"omega", 3}, {"order", 5}, {"mode", 2}};
  file.variables = {
      {"",
       NC_DOUBLE,
       {},
       {{"content", "order map of gearsweep"}, {"axis", "omega"}, {"channel", "dmf"}},
       {},
       ""},
      {"omega", NC_DOUBLE, {0}, {{"units", "varpi"}}, {0.5, 1.0, 2.0}, ""},
      {"order", NC_DOUBLE, {1}, {}, {}, ""},
      {"forcing_frequency", NC_DOUBLE, {0}, {{"units", "varpi"}}, {0.5, 1.0, 2.0}, ""},
      {"amplitude", NC_DOUBLE, {0, 1}, {{"units", "k0 b_n"}}, {}, ""},
      {"natural_frequency", NC_DOUBLE, {0, 2}, {{"units", "varpi"}}, {}, ""}};
  return file;
}

// The bytes as choices; zeros when they have run out.
class Choices {
 public:
  explicit Choices(const std::string& bytes) : bytes_(bytes) {}

  bool empty() const { return at_ >= bytes_.size(); }
  std::size_t below(std::size_t end) { return end == 0 ? 0 : next() % end; }
  double number() {
    constexpr std::array kOdd = {0.0,
                                 -0.0,
                                 1.0,
                                 -1.0,
                                 0.5,
                                 1e-300,
                                 1e300,
                                 -1e300,
                                 1e19,
                                 2e9,
                                 1e6,
                                 254.0,
                                 -2.0,
                                 std::numeric_limits<double>::max(),
                                 std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::quiet_NaN()};
    const std::size_t choice = next();
    return choice < kOdd.size() ? kOdd[choice] : static_cast<double>(choice) - 100.0;
  }
  std::vector<double> numbers() {
    std::vector<double> out(below(12));
    for (double& number : out) number = this->number();
    return out;
  }
  std::string text() {
    const std::size_t length = std::min(below(24), bytes_.size() - std::min(at_, bytes_.size()));
    at_ += length;
    return bytes_.substr(at_ - length, length);
  }
  std::string name() {
    constexpr std::array kNames = {"status",
                                   "omega",
                                   "b",
                                   "x1_rms",
                                   "contact_class",
                                   "lyapunov_spectrum",
                                   "state",
                                   "poincare",
                                   "sample",
                                   "state_units",
                                   "state_long_name",
                                   "exponent",
                                   "trace",
                                   "moment",
                                   "label",
                                   "period",
                                   "tau",
                                   "x1",
                                   "v1",
                                   "dmf",
                                   "contact",
                                   "lyapunov_max"};
    const std::size_t choice = next();
    return choice < kNames.size() ? kNames[choice] : text();
  }
  std::string attribute() {
    constexpr std::array kNames = {
        "units", "long_name", "scale",   "flag_values",    "flag_meanings",    "_FillValue",
        "study", "title",     "content", "pilot_max_step", "pilot_orbit_steps"};
    return kNames[below(kNames.size())];
  }

 private:
  std::uint8_t next() { return empty() ? 0 : static_cast<std::uint8_t>(bytes_[at_++]); }

  const std::string& bytes_;
  std::size_t at_ = 0;
};

// One edit; what it names may not be there, then it does nothing.
void edit(Choices* choices, File* file) {
  constexpr std::array<nc_type, 8> kTypes = {NC_BYTE,  NC_CHAR,  NC_FLOAT,  NC_DOUBLE,
                                             NC_INT64, NC_UBYTE, NC_UINT64, NC_STRING};
  constexpr std::array<std::size_t, 8> kSizes = {
      0, 1, 2, 3, 100, 20'000, 4'294'967'296, 1'000'000'000'000};
  Variable& variable = file->variables[choices->below(file->variables.size())];
  Dimension& dimension = file->dimensions[choices->below(file->dimensions.size())];
  const auto set_attribute = [&](Value value) {
    variable.attributes.push_back({choices->attribute(), std::move(value)});
  };
  switch (choices->below(11)) {
    case 0:
      dimension.name = choices->name();
      break;
    case 1:
      dimension.size = kSizes[choices->below(kSizes.size())];
      break;
    case 2:
      variable.name = choices->name();
      break;
    case 3:
      variable.type = kTypes[choices->below(kTypes.size())];
      break;
    case 4:
      variable.dimensions.push_back(choices->below(file->dimensions.size()));
      break;
    case 5:
      if (!variable.dimensions.empty()) variable.dimensions.pop_back();
      break;
    case 6:
      variable.numbers = choices->numbers();
      break;
    case 7:
      variable.text = choices->text();
      break;
    case 8:
      set_attribute(choices->numbers());
      break;
    case 9:
      set_attribute(choices->text());
      break;
    default:
      file->variables.push_back(Variable(variable));
      file->variables.back().name = choices->name();
  }
}

// What the library refuses is left out.
void write_attributes(int id, int variable, const std::vector<Attribute>& attributes) {
  for (const auto& [name, value] : attributes) {
    if (const auto* text = std::get_if<std::string>(&value)) {
      nc_put_att_text(id, variable, name.c_str(), text->size(), text->data());
    } else {
      const auto& numbers = std::get<std::vector<double>>(value);
      nc_put_att_double(id, variable, name.c_str(), NC_DOUBLE, numbers.size(), numbers.data());
    }
  }
}

void write_values(int id, int variable, const Variable& from, std::size_t count) {
  if (from.type == NC_CHAR) {
    std::string text = from.text;
    text.resize(count, ' ');
    nc_put_var_text(id, variable, text.data());
    return;
  }
  std::vector<double> numbers = from.numbers;
  while (numbers.size() < count) numbers.push_back(static_cast<double>(numbers.size()));
  nc_put_var_double(id, variable, numbers.data());
}

void write(const File& file, const std::string& path) {
  constexpr std::size_t kMaxWritten = 4096;
  int id = -1;
  if (nc_create(path.c_str(), NC_NETCDF4 | NC_CLOBBER, &id) != NC_NOERR) return;
  std::vector<int> dimensions;
  for (const Dimension& dimension : file.dimensions) {
    int made = -1;
    nc_def_dim(id, dimension.name.c_str(), dimension.size, &made);
    dimensions.push_back(made);
  }
  write_attributes(id, NC_GLOBAL, file.variables.front().attributes);
  for (std::size_t i = 1; i < file.variables.size(); ++i) {
    const Variable& variable = file.variables[i];
    std::vector<int> own;
    double count = 1.0;
    for (const std::size_t dimension : variable.dimensions) {
      own.push_back(dimensions[dimension]);
      count *= static_cast<double>(file.dimensions[dimension].size);
    }
    int made = -1;
    if (nc_def_var(id, variable.name.c_str(), variable.type, static_cast<int>(own.size()),
                   own.data(), &made) != NC_NOERR) {
      continue;
    }
    write_attributes(id, made, variable.attributes);
    if (count <= kMaxWritten) {
      write_values(id, made, variable, static_cast<std::size_t>(count));
    }
  }
  nc_close(id);
}

}  // namespace

void read_hostile_result(const std::string& bytes) {
  constexpr std::size_t kMaxEdits = 24;
  Choices choices(bytes);
  constexpr std::size_t kBytes = 256, kOrders = 254;
  const std::size_t kind = choices.below(kBytes);
  File file = kind == kOrders ? good_orders() : kind % 3 == 2 ? good_traces() : good_map();
  for (std::size_t i = 0; i < kMaxEdits && !choices.empty(); ++i) edit(&choices, &file);
  const TemporaryFolder folder;
  const std::string path = (folder.path() / "hostile.nc").string();
  write(file, path);
  read_all_of(path);
}

}  // namespace gearsweep::testing
