// A file of the gear exchange format REXS (www.rexs.info, versions 1.0 to 1.7) as it stands:
// components with attributes, the relations between them, and load cases. What they mean for gears
// is in gear_unit.hpp.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gearsweep {

struct RexsAttribute {
  std::string id;
  std::string unit;  // as it stands; empty: none is given
  std::string text;  // of a scalar; of a list without numbers its words, with blanks between
  std::vector<double>
      numbers;   // of a number one, of a list all, of a matrix row by row; only finite
  int line = 0;  // 0: not known
};

struct RexsComponent {
  std::string id, type, name;
  std::vector<RexsAttribute> attributes;
  int line = 0;

  // nullptr where there is none; the first of several.
  const RexsAttribute* find(std::string_view attribute) const;
  // "shaft 12 (Input shaft)"
  std::string label() const;
};

struct RexsReference {
  std::string component, role;
};

struct RexsRelation {
  std::string id, type;
  std::vector<RexsReference> references;
  int line = 0;

  // The component of this role; empty where there is none.
  std::string_view of_role(std::string_view role) const;
  bool names(std::string_view component) const;
};

struct RexsLoadCase {
  std::string id;
  std::vector<RexsComponent> components;  // with the attributes that differ in this case
};

struct RexsDocument {
  std::string source;  // what messages call it
  std::string version, application;
  std::vector<RexsComponent> components;  // each id once
  std::vector<RexsRelation> relations;    // between components that there are
  std::vector<RexsLoadCase> load_cases;
  std::vector<std::string> notices;  // what is odd in it, with the line where that is known

  const RexsComponent* find(std::string_view component) const;
  // "unit.rexs:12", or without a line.
  std::string place(int line) const;
};

// XML or JSON, whichever it is. Throws InputError, with the line where that is known, for what is
// neither, is no REXS, is nested too deep, has a document type or two components of one id.
RexsDocument read_rexs(const std::string& bytes, const std::string& source);

// The same of a file, which has at most 64 MiB.
RexsDocument read_rexs_file(const std::string& path);

}  // namespace gearsweep
