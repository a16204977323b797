// Runs the gearsweep program as a user does, and a fresh folder to run it in.
#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

namespace gearsweep::testing {

struct Outcome {
  int status = 0;
  std::string out, err;
};

inline std::string read_all(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

// An empty folder that is removed at the end of the test.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "gearsweep-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a test folder");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  void remove(const std::string& name) const { std::filesystem::remove(path_ / name); }
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) {
      names.insert(entry.path().filename().string());
    }
    return names;
  }

 private:
  std::filesystem::path path_;
};

// Runs a shell command in a folder.
inline Outcome run_in(const Folder& folder, const std::string& command) {
  const Folder log;
  const std::string line = "cd '" + folder.path().string() + "' && " + command + " > '" +
                           (log / "out").string() + "' 2> '" + (log / "err").string() + "'";
  const int status = std::system(line.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_all(log / "out"),
          read_all(log / "err")};
}

// Runs the program that was built with these tests: "run study.toml -o out.nc".
inline Outcome gearsweep(const Folder& folder, const std::string& arguments) {
  return run_in(folder, std::string(GEARSWEEP_BINARY) + " " + arguments);
}

}  // namespace gearsweep::testing
