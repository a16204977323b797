#include "result/result_size.hpp"

#include <algorithm>

#include "result/detail/derived_coordinates.hpp"
#include "study/settings.hpp"

namespace gearsweep {
namespace {

// Bytes that the format (HDF5) takes beside the numbers. Its documents give no bound: these are
// about twice what was measured, and tests/result/result_size_test.cpp tries them on random
// studies.
constexpr double kFile = 32768.0;     // of a file without variables
constexpr double kVariable = 8192.0;  // its header, its attributes, a node of its chunks' index
constexpr double kChunk = 128.0;      // its entry in the index, whose nodes may be half empty
// A chunk of a map is not smaller, as the NetCDF library chooses it, unless the map is.
constexpr double kChunkOfMap = 65536.0;
// The shares of bytes that cannot be compressed, and of the fill values where blocks reach beyond
// the map.
constexpr double kPacked = 1.001, kFill = 0.01;
constexpr double kCache = 16.0 * 1024.0 * 1024.0;  // memory of the NetCDF library for a variable

std::size_t points_along_y(const Study& study) {
  return study.points() / study.axes.front().values.size();
}

double real_bytes(const Study& study) { return study.integrate.fp64 ? 8.0 : 4.0; }

double sample_bytes(const Study& study) {  // of a point
  return real_bytes(study) *
         static_cast<double>(study.selection.poincare.size() * study.integrate.record);
}

// So many pieces that none is larger than `most`, all but the last as large.
std::size_t even_piece(std::size_t whole, std::size_t most) {
  const std::size_t pieces = (whole + most - 1) / most;
  return (whole + pieces - 1) / pieces;
}

// Adds up what goes into the file.
class Sum {
 public:
  ResultSize size;

  // Over the map, or along one dimension.
  void add(double bytes) { add(bytes, 0.0, bytes / kChunkOfMap + 1.0, 0.0); }
  void add_text(const std::string& text) { size.file += static_cast<double>(text.size()); }
  void add_described(const std::string& unit, const std::string& meaning, double bytes) {
    add(bytes);
    add_text(unit);
    add_text(meaning);
  }
  // What they are called and measured in, in lists of equally long texts.
  void add_channels(const std::vector<ChannelInfo>& channels) {
    std::size_t longest = 1;
    for (const ChannelInfo& channel : channels) {
      longest =
          std::max({longest, channel.name.size(), channel.unit.size(), channel.meaning.size()});
    }
    constexpr int kTexts = 4;  // names, units, meanings, units of SI
    for (int list = 0; list < kTexts; ++list) {
      add(static_cast<double>(channels.size() * longest));
      add(0.0);  // the dimension of its letters
    }
    add(8.0 * static_cast<double>(channels.size()));  // scales
  }
  // Samples of the study.
  void add_samples(const Study& study) {
    const SampleBlock block = block_of_samples(study);
    const auto blocks = [](std::size_t whole, std::size_t piece) {
      const std::size_t pieces = (whole + piece - 1) / piece;
      return static_cast<double>(pieces);
    };
    const double chunks = blocks(study.axes.front().values.size(), block.columns) *
                          blocks(points_along_y(study), block.rows);
    const double bytes = sample_bytes(study) * static_cast<double>(study.points());
    const double chunk = sample_bytes(study) * static_cast<double>(block.rows * block.columns);
    add(bytes, chunks * chunk - bytes, chunks, chunk);
  }

 private:
  void add(double bytes, double fill, double chunks, double chunk) {
    size.file += kVariable + kPacked * bytes + kFill * fill + kChunk * chunks;
    // A chunk that is larger than the cache is packed beside it.
    size.memory += std::min(2.0 * bytes, kCache) + 2.0 * chunk;
  }
};

void add_axes(const Study& study, Sum* sum) {
  for (const Axis& axis : study.axes) {
    const double bytes = 8.0 * static_cast<double>(axis.values.size());
    sum->add_described(axis.unit, axis.meaning, bytes);
    for (const std::vector<Swept>* all : {&axis.columns, &axis.others}) {
      for (const Swept& column : *all) sum->add_described(column.unit, column.meaning, bytes);
    }
  }
  for (const DerivedCoordinate& one : derived_coordinates(study)) {
    const double bytes = 8.0 * static_cast<double>(size_of(one, study));
    sum->add_described(one.parameter.unit, one.parameter.meaning, bytes);
    sum->add_text(one.expression);
    sum->size.memory += bytes;
  }
}

// The numbers of the widest map wait on their way into the file: as the file has them, and packed.
void add_maps(const Study& study, Sum* sum) {
  const auto points = static_cast<double>(study.points());
  const double real = real_bytes(study);
  sum->add(points);  // status
  if (study.spectrum) sum->add(8.0 * points);
  double widest = 1.0;
  for (const Quantity& quantity : study.selection.quantities) {
    const bool is_class = !quantity.flags.empty();
    const auto width = static_cast<double>(quantity.width);
    sum->add_described(quantity.unit, quantity.meaning, (is_class ? 1.0 : real) * width * points);
    for (const std::string& flag : quantity.flags) sum->add_text(flag);
    widest = std::max(widest, width);
    if (quantity.width > 1) {
      sum->add(4.0 * width);  // the coordinate of its own dimension
      sum->add_channels(study.model->states);
    }
  }
  sum->size.memory += 2.0 * real * widest * points;
}

void add_draws(const Uncertain& uncertain, Sum* sum) {
  const std::vector<UncertainParameter>& parameters = uncertain.parameters;
  sum->add(8.0 * static_cast<double>(uncertain.independent_draws() * parameters.size()));
  std::vector<ChannelInfo> shown;
  for (const UncertainParameter& parameter : parameters) {
    const Axis& draws = parameter.draws;
    shown.push_back({draws.name, draws.unit, "factor of the point's own " + draws.meaning});
  }
  sum->add_channels(shown);
}

// Each trajectory may reach an attractor of its own.
void add_attractors(const Study& study, Sum* sum) {
  constexpr int kNumbers = 6;
  const auto most = static_cast<double>(study.trajectories());
  sum->add(4.0 * most);
  for (int number = 0; number < kNumbers; ++number) sum->add(8.0 * most);
}

void add_sections(const Study& study, Sum* sum) {
  sum->add_samples(study);
  sum->add(4.0 * static_cast<double>(study.integrate.record));
  std::vector<ChannelInfo> sampled;
  for (const std::size_t state : study.selection.poincare) {
    sampled.push_back(study.model->states[state]);
  }
  sum->add_channels(sampled);
}

}  // namespace

SampleBlock block_of_samples(const Study& study) {
  constexpr double kBlock = 1024.0 * 1024.0;
  const auto fitting = [&](double bytes, std::size_t whole) {
    const double most = std::clamp(kBlock / bytes, 1.0, static_cast<double>(whole));
    return even_piece(whole, static_cast<std::size_t>(most));
  };
  const std::size_t row = study.axes.front().values.size();
  SampleBlock block;
  block.columns = fitting(sample_bytes(study), row);
  if (block.columns == row) {
    block.rows = fitting(sample_bytes(study) * static_cast<double>(row), points_along_y(study));
  }
  return block;
}

ResultSize size_of_result(const Study& study, const Provenance& provenance) {
  Sum sum;
  sum.size.file = kFile;
  for (const std::string& text :
       {study.title, study.brief_toml(), resolved_settings(study), provenance.command_line,
        provenance.version, provenance.source_hash}) {
    sum.add_text(text);
  }
  add_axes(study, &sum);
  add_maps(study, &sum);
  if (study.uncertain.keep) add_draws(study.uncertain, &sum);
  if (study.selection.census) add_attractors(study, &sum);
  if (!study.selection.poincare.empty()) add_sections(study, &sum);
  return sum.size;
}

}  // namespace gearsweep
