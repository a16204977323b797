#include "result/detail/dataset_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>

#include "result/detail/netcdf_file.hpp"
#include "result/output_file.hpp"

namespace gearsweep {
namespace {

nc_type type_of(Stored stored) {
  switch (stored) {
    case Stored::letter:
      return NC_CHAR;
    case Stored::byte:
      return NC_BYTE;
    case Stored::integer:
      return NC_INT;
    case Stored::single:
      return NC_FLOAT;
    case Stored::real:
      break;
  }
  return NC_DOUBLE;
}

// A block of a variable: `size` elements, from number `first` on.
struct Block {
  std::vector<std::size_t> start, count;
  std::size_t first = 0, size = 0;
};

class DatasetWriter {
 public:
  DatasetWriter(const Dataset& dataset, NetcdfFile* file) : dataset_(dataset), file_(*file) {}

  void write() {
    file_.put_attributes(NC_GLOBAL, dataset_.attributes);
    for (const Dimension& dimension : dataset_.dimensions) {
      dimensions_[dimension.name] = file_.define_dimension(dimension.name, dimension.size);
    }
    for (const DataVariable& variable : dataset_.variables)
      put_elements(variable, define(variable));
  }

 private:
  int define(const DataVariable& variable) {
    std::vector<int> dimensions;
    for (const std::string& name : variable.dimensions) dimensions.push_back(dimensions_.at(name));
    const int id = file_.define_variable(variable.name, type_of(variable.stored), dimensions);
    file_.put_attributes(id, variable.attributes);
    if (!variable.chunk.empty()) {
      file_.check(nc_def_var_chunking(file_.id(), id, NC_CHUNKED, variable.chunk.data()),
                  fmt::format("set the chunks of '{}'", variable.name));
    }
    if (variable.is_compressed) file_.compress(id);
    return id;
  }

  // A chunk at a time, so that no more than one is held twice.
  void put_elements(const DataVariable& variable, int id) {
    const std::vector<std::size_t> shape = dataset_.shape_of(variable);
    const std::vector<std::size_t>& piece = variable.chunk.empty() ? shape : variable.chunk;
    const auto product = [](const std::vector<std::size_t>& sizes) {
      return std::accumulate(sizes.begin(), sizes.end(), std::size_t{1}, std::multiplies<>());
    };
    const std::size_t all = product(shape);
    for (Block block{.start = {}, .count = {}}; block.first < all; block.first += block.size) {
      block.start = place_of(block.first, shape);
      block.count.clear();
      for (std::size_t i = 0; i < shape.size(); ++i) {
        block.count.push_back(std::min(piece[i], shape[i] - block.start[i]));
      }
      block.size = product(block.count);
      put_block(variable, id, block);
    }
  }

  // The place of an element, the last dimension fastest.
  static std::vector<std::size_t> place_of(std::size_t element,
                                           const std::vector<std::size_t>& shape) {
    std::vector<std::size_t> place(shape.size());
    for (std::size_t i = shape.size(); i-- > 0; element /= shape[i]) place[i] = element % shape[i];
    return place;
  }

  void put_block(const DataVariable& variable, int id, const Block& block) {
    switch (variable.stored) {
      case Stored::letter:
        file_.put_text(id, block.start, block.count,
                       std::string_view(std::get<std::string>(variable.elements))
                           .substr(block.first, block.size));
        return;
      case Stored::byte:
        return put_as<signed char>(variable, id, block);
      // The library would call it an error when an infinity is to become a float.
      case Stored::single:
        return put_as<float>(variable, id, block);
      case Stored::integer:
        return put_as<double>(variable, id, block);
      case Stored::real:
        break;
    }
    if (const auto* view = std::get_if<std::span<const double>>(&variable.elements)) {
      file_.put(id, block.start, block.count, view->subspan(block.first, block.size));
    } else {
      put_as<double>(variable, id, block);
    }
  }

  template <typename T>
  void put_as(const DataVariable& variable, int id, const Block& block) {
    std::vector<T> elements(block.size);
    variable.copy(block.first, std::span<T>(elements));
    file_.put(id, block.start, block.count, elements);
  }

  const Dataset& dataset_;
  NetcdfFile& file_;
  std::map<std::string, int> dimensions_;
};

}  // namespace

void write_dataset(const Dataset& dataset, const std::string& path) {
  OutputFile output(path);
  NetcdfFile file = NetcdfFile::create(output.temporary_path(), path);
  DatasetWriter(dataset, &file).write();
  file.close();
  output.commit();
}

}  // namespace gearsweep
