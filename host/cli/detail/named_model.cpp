#include "cli/detail/named_model.hpp"

#include <fmt/format.h>

#include "model/error.hpp"
#include "model/names.hpp"
#include "study/builtin_models.hpp"
#include "study/model_file.hpp"
#include "study/table_file.hpp"
#include "study/toml_text.hpp"

namespace gearsweep {

NamedModel named_model(const std::string& name_or_path) {
  if (name_or_path.find_first_of("./") != std::string::npos) {
    return {read_model_text(model_file_text(name_or_path), name_or_path, {},
                            tables_beside(name_or_path)),
            fmt::format("file = {}", toml_quoted(name_or_path))};
  }
  const Model* model = find_model(name_or_path);
  if (model == nullptr) {
    throw InputError(fmt::format("unknown model '{}'{}", name_or_path,
                                 suggest_name(name_or_path, model_names())));
  }
  // Built-in models live as long as the program.
  return {std::shared_ptr<const Model>(std::shared_ptr<void>(), model),
          fmt::format("name = {}", toml_quoted(name_or_path))};
}

}  // namespace gearsweep
