#include "model/mirror_pairs.hpp"

#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/names.hpp"

namespace gearsweep {
namespace {

std::vector<MirrorPairs::Pair> pairs_of(std::string_view names,
                                        const std::function<int(const std::string&)>& find) {
  const auto index = [&](const std::string& name) {
    const int found = find(name);
    if (found < 0) throw std::logic_error("no '" + name + "' to mirror");
    return static_cast<std::size_t>(found);
  };
  std::vector<MirrorPairs::Pair> pairs;
  const std::vector<std::string> words = split_words(names);
  for (std::size_t i = 0; i + 1 < words.size(); i += 2) {
    pairs.push_back({index(words[i]), index(words[i + 1])});
  }
  return pairs;
}

}  // namespace

MirrorPairs mirror_pairs_of(const Model& model, std::string_view states,
                            std::string_view parameters) {
  return {
      pairs_of(states, [&](const std::string& name) { return model.find_state(name); }),
      pairs_of(parameters, [&](const std::string& name) { return model.find_parameter(name); })};
}

}  // namespace gearsweep
