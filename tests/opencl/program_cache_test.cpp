// Programs kept on disk: what is found again, what is not, and what a spoilt file does.
#include "opencl/detail/program_cache.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <future>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "model/error.hpp"
#include "opencl/detail/program.hpp"
#include "opencl/device.hpp"
#include "study/study.hpp"
#include "support/bits.hpp"
#include "sweep/sweep.hpp"

namespace gearsweep::testing {
namespace {

namespace fs = std::filesystem;

// A variable of the environment while it lives; nothing means unset.
class Environment {
 public:
  Environment(const char* name, const std::optional<std::string>& value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    set(value);
  }
  ~Environment() { set(before_); }
  Environment(const Environment&) = delete;
  Environment& operator=(const Environment&) = delete;

 private:
  void set(const std::optional<std::string>& value) {
    if (value) {
      setenv(name_, value->c_str(), 1);
    } else {
      unsetenv(name_);
    }
  }

  const char* name_;
  std::optional<std::string> before_;
};

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// A kernel that writes its number, and is quick to compile.
std::string writes(int number) {
  return "__kernel void write_number(__global int* out) { out[get_global_id(0)] = " +
         std::to_string(number) + "; }\n";
}

const std::string kOptions = "-cl-std=CL1.2";

class ProgramCache : public ::testing::Test {
 protected:
  ProgramCache() : device_(find_devices().at(default_device(list_devices()))), context_(device_) {
    std::string name = (fs::temp_directory_path() / "gearsweep-test-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make a test folder");
    parent_ = name;
    folder_ = parent_ / "deeper" / "cache";
  }
  ~ProgramCache() override { fs::remove_all(parent_); }

  cl::Program get(const std::string& source, const std::string& options = kOptions) {
    return cached_program(context_, device_, source, options, folder_);
  }

  // What the kernel of writes() writes.
  int run(const cl::Program& program) {
    int out = 0;
    const cl::CommandQueue queue(context_, device_);
    const cl::Buffer buffer(context_, CL_MEM_READ_WRITE, sizeof(out));
    cl::Kernel kernel(program, "write_number");
    kernel.setArg(0, buffer);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(1), cl::NDRange(1));
    queue.enqueueReadBuffer(buffer, CL_TRUE, 0, sizeof(out), &out);
    return out;
  }

  // OpenCL knows no source of a program that was made from a binary.
  static bool came_from_disk(const cl::Program& program) {
    return program.getInfo<CL_PROGRAM_SOURCE>().find("write_number") == std::string::npos;
  }

  std::vector<fs::path> files() const {
    std::vector<fs::path> paths;
    for (const auto& entry : fs::directory_iterator(folder_)) paths.push_back(entry.path());
    return paths;
  }

  fs::path only_file() const {
    const std::vector<fs::path> paths = files();
    if (paths.size() != 1) throw std::runtime_error("the cache does not hold one file");
    return paths.front();
  }

  // Spoils the one program that is kept; it is built again, and its file put right.
  void expect_rebuilt_after(const std::function<std::string(const std::string&)>& spoil) {
    EXPECT_FALSE(came_from_disk(get(writes(7))));
    const fs::path path = only_file();
    const std::string whole = read(path);
    std::ofstream(path, std::ios::binary) << spoil(whole);
    ASSERT_NE(read(path), whole);
    const cl::Program rebuilt = get(writes(7));
    EXPECT_FALSE(came_from_disk(rebuilt));
    EXPECT_EQ(run(rebuilt), 7);
    EXPECT_EQ(only_file(), path);
    const cl::Program again = get(writes(7));
    EXPECT_TRUE(came_from_disk(again));
    EXPECT_EQ(run(again), 7);
  }

  const cl::Device device_;
  const cl::Context context_;
  fs::path parent_, folder_;
};

TEST_F(ProgramCache, FindsAProgramAgain) {
  const cl::Program built = get(writes(5));
  EXPECT_FALSE(came_from_disk(built));
  const cl::Program found = get(writes(5));
  EXPECT_TRUE(came_from_disk(found));
  EXPECT_EQ(run(found), run(built));
  EXPECT_EQ(files().size(), 1U);
}

TEST_F(ProgramCache, AnotherSourceIsAnotherProgram) {
  get(writes(1));
  const cl::Program other = get(writes(2));
  EXPECT_FALSE(came_from_disk(other));
  EXPECT_EQ(run(other), 2);
  EXPECT_EQ(run(get(writes(1))), 1);
  EXPECT_EQ(files().size(), 2U);
}

TEST_F(ProgramCache, OtherOptionsAreAnotherProgram) {
  const std::string source = "__kernel void write_number(__global int* out) { *out = NUMBER; }\n";
  EXPECT_EQ(run(get(source, kOptions + " -DNUMBER=1")), 1);
  EXPECT_EQ(run(get(source, kOptions + " -DNUMBER=2")), 2);
  EXPECT_EQ(files().size(), 2U);
}

TEST_F(ProgramCache, ATruncatedFileIsBuiltAgain) {
  expect_rebuilt_after([](const std::string& whole) { return whole.substr(0, whole.size() / 2); });
}

TEST_F(ProgramCache, AnEmptyFileIsBuiltAgain) {
  expect_rebuilt_after([](const std::string&) { return std::string(); });
}

TEST_F(ProgramCache, AFileWithOneOtherByteIsBuiltAgain) {
  expect_rebuilt_after([](std::string whole) {
    whole[whole.size() - 100] ^= 1;
    return whole;
  });
}

// What an older driver may have left: whole, but of no use. The hash is FNV-1a, written once more.
TEST_F(ProgramCache, ABinaryThatTheDeviceRefusesIsBuiltAgain) {
  expect_rebuilt_after([](const std::string& whole) {
    const std::size_t hash = whole.find('\n') + 1;
    const std::size_t key = whole.find('\n', hash) + 1;
    const std::size_t key_size = std::stoul(whole.substr(hash + 17));
    const std::string refused = "no program";
    std::uint64_t number = 14695981039346656037U;
    for (const char c : refused) number = (number ^ static_cast<std::uint64_t>(c)) * 1099511628211U;
    return whole.substr(0, hash) + fmt::format("{:016x}", number) +
           whole.substr(hash + 16, key + key_size + 1 - hash - 16) + refused;
  });
}

TEST_F(ProgramCache, AFolderInPlaceOfTheFileIsNone) {
  get(writes(3));
  const fs::path path = only_file();
  fs::remove(path);
  fs::create_directory(path);
  EXPECT_EQ(run(get(writes(3))), 3);
  EXPECT_EQ(only_file(), path);  // and nothing unfinished is left
}

// Two keys of one hash: simulated by the file of another program under this program's name.
TEST_F(ProgramCache, AFileOfAnotherProgramIsNotTaken) {
  get(writes(1));
  const fs::path path = only_file();
  const std::string first = read(path);
  fs::remove(path);
  get(writes(2));
  std::ofstream(only_file(), std::ios::binary) << first;
  const cl::Program program = get(writes(2));
  EXPECT_FALSE(came_from_disk(program));
  EXPECT_EQ(run(program), 2);
}

TEST_F(ProgramCache, AnErrorInTheSourceIsNotKept) {
  EXPECT_THROW(get("this_is_no_type broken;\n"), RunError);
  EXPECT_FALSE(fs::exists(folder_));
}

TEST_F(ProgramCache, AFolderThatCannotBeMadeIsNone) {
  std::ofstream(parent_ / "deeper") << "a file where a folder should be";
  EXPECT_EQ(run(get(writes(3))), 3);
  EXPECT_FALSE(came_from_disk(get(writes(3))));
}

TEST_F(ProgramCache, HoldsTheProgramsThatWereUsedLast) {
  get(writes(1));
  const fs::path used = only_file();
  // 70 others, an unfinished one among them, each an hour older than the one before.
  const fs::file_time_type now = fs::file_time_type::clock::now();
  for (int i = 0; i < 70; ++i) {
    const std::string name = "00000000000000" + std::to_string(10 + i) + ".gearsweep-program" +
                             (i == 65 ? ".abcdef" : "");
    std::ofstream(folder_ / name) << i;
    fs::last_write_time(folder_ / name, now - std::chrono::hours(i + 1));
  }
  std::ofstream(folder_ / "notes.txt") << "not ours";
  fs::last_write_time(folder_ / "notes.txt", now - std::chrono::hours(1000));
  fs::last_write_time(used, now - std::chrono::hours(2000));
  EXPECT_TRUE(came_from_disk(get(writes(1))));  // which makes it one of the last used

  get(writes(2));
  EXPECT_EQ(files().size(), 64U + 1U);  // and what is not the cache's
  EXPECT_TRUE(fs::exists(used));
  EXPECT_TRUE(fs::exists(folder_ / "notes.txt"));
  EXPECT_TRUE(fs::exists(folder_ / "0000000000000071.gearsweep-program"));
  EXPECT_FALSE(fs::exists(folder_ / "0000000000000072.gearsweep-program"));
  EXPECT_FALSE(fs::exists(folder_ / "0000000000000075.gearsweep-program.abcdef"));
}

TEST_F(ProgramCache, ManyWritersLeaveOneWholeFile) {
  std::vector<std::future<int>> runs;
  for (int i = 0; i < 4; ++i) {
    runs.push_back(std::async(std::launch::async, [this] { return run(get(writes(9))); }));
  }
  for (std::future<int>& result : runs) EXPECT_EQ(result.get(), 9);
  EXPECT_EQ(files().size(), 1U);
  EXPECT_TRUE(came_from_disk(get(writes(9))));
}

TEST_F(ProgramCache, AKeptProgramGivesTheSameBits) {
  const std::string study =
      "[model]\npreset = 'coarse'\n[[axes]]\nname = 'omega'\nfrom = 0.3\nto = 1.9\ncount = 13\n"
      "[integrate]\nsettle = 31\nrecord = 7\n[observe]\nquantities = ['x1_rms', 'dmf_max']\n";
  const auto maps = [&](const std::string& folder) {
    const Environment environment("GEARSWEEP_CACHE_DIR", folder);
    return run_sweep(read_study(study, "test.toml"), {})->values;  // with devices of its own
  };
  const std::vector<std::vector<double>> expected = maps("");
  EXPECT_FALSE(fs::exists(folder_));
  for (int i = 0; i < 2; ++i) {  // built and kept, then found
    const std::vector<std::vector<double>> kept = maps(folder_.string());
    ASSERT_EQ(kept.size(), expected.size());
    for (std::size_t j = 0; j < kept.size(); ++j) {
      EXPECT_EQ(different_bits(kept[j], expected[j]), 0U);
    }
    EXPECT_EQ(files().size(), 2U);  // the sweep's, and that of the search for orbits
  }
}

TEST_F(ProgramCache, NoFolderMeansNoCache) {
  folder_.clear();
  EXPECT_EQ(run(get(writes(4))), 4);
  EXPECT_FALSE(came_from_disk(get(writes(4))));
  EXPECT_TRUE(fs::is_empty(parent_));
}

constexpr const char* kPlatform = "Some Platform";
constexpr const char* kPocl = "Portable Computing Language";

TEST(ProgramCacheFolder, IsWhatTheEnvironmentSays) {
  const Environment named("GEARSWEEP_CACHE_DIR", "/some/where");
  EXPECT_EQ(program_cache_folder(kPlatform), "/some/where");
  EXPECT_EQ(program_cache_folder(kPocl), "/some/where");
  const Environment off("GEARSWEEP_CACHE_DIR", "");
  EXPECT_EQ(program_cache_folder(kPlatform), "");
}

TEST(ProgramCacheFolder, IsAmongTheUsersCaches) {
  const Environment unnamed("GEARSWEEP_CACHE_DIR", std::nullopt);
  const Environment home("HOME", "/home/someone");
  const Environment caches("XDG_CACHE_HOME", "/caches");
  EXPECT_EQ(program_cache_folder(kPlatform), "/caches/gearsweep");
  const Environment relative("XDG_CACHE_HOME", "caches");  // to be ignored, by its specification
  EXPECT_EQ(program_cache_folder(kPlatform), "/home/someone/.cache/gearsweep");
  const Environment no_caches("XDG_CACHE_HOME", std::nullopt);
  EXPECT_EQ(program_cache_folder(kPlatform), "/home/someone/.cache/gearsweep");
  const Environment homeless("HOME", std::nullopt);
  EXPECT_EQ(program_cache_folder(kPlatform), "");
}

TEST(ProgramCacheFolder, IsNoneWherePoclKeepsKernels) {
  const Environment unnamed("GEARSWEEP_CACHE_DIR", std::nullopt);
  const Environment caches("XDG_CACHE_HOME", "/caches");
  EXPECT_EQ(program_cache_folder(kPocl), "");
}

}  // namespace
}  // namespace gearsweep::testing
