// The page of the explorer, embedded from explore/.
#pragma once

#include <map>
#include <string>

namespace gearsweep {

// By name: "index.html", "app.js".
const std::map<std::string, std::string>& page_files();

}  // namespace gearsweep
