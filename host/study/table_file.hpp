// The file of a measured curve: columns of text to the points of a PeriodicTable.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "equations/definition.hpp"
#include "gear/value_units.hpp"

namespace gearsweep {

// text: two columns, the phase and the value, with a comma, a semicolon or white space between.
// '#' begins a comment. A first line of names may say in its first one what the phase is in:
// `phase` (rad), `share` (of the period) or `degree`, and in its last one of `units` what the
// values are in; the points have them in the one of scale 1. The points rise over one period; the
// last may be the first one, a period later. Throws InputError "source:line: message".
std::vector<TablePoint> parse_table(std::string_view text, const std::string& source,
                                    std::span<const ValueUnit> units = {});

// The same points as parse_table() reads from it, bit by bit: "phase value", in rad, per line.
std::string table_text(const std::vector<TablePoint>& points);

// Reads the file at `path`. Throws InputError.
std::vector<TablePoint> read_table(const std::string& path, std::span<const ValueUnit> units = {});

// Reads tables whose names are relative to the folder of a model's file.
TablePoints tables_beside(const std::string& model_file);

}  // namespace gearsweep
