// The text of a kernel header while it is written.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "equations/detail/statements.hpp"
#include "model/model.hpp"

namespace gearsweep {

class KernelText {
 public:
  // Both must outlive it.
  KernelText(const ExpressionGraph* graph, const std::vector<ChannelInfo>& states)
      : graph_(graph), states_(states) {}

  // "STATE_x".
  std::string state_index(std::size_t state) const;
  // A place of an array for each state.
  std::vector<Assignment> places(const std::string& array, const std::vector<NodeId>& ids) const;

  // unused: what the function may do without, with blanks between; before: statements.
  void write_function(const std::string& name, const std::string& arguments,
                      const std::vector<Assignment>& assignments, const std::string& unused,
                      const std::string& before = "");
  // A function for each contact or surface, and one that chooses among them.
  void write_by_contact(const std::string& name, const std::string& parameters,
                        const std::string& arguments,
                        const std::vector<std::vector<Assignment>>& bodies);
  // A list of X(row).
  void write_list(const std::string& macro, const std::vector<std::string>& rows);

  std::map<NodeId, std::string> names;  // how symbols are written
  std::string out;

 private:
  const ExpressionGraph* graph_;
  const std::vector<ChannelInfo>& states_;
};

}  // namespace gearsweep
