#include "plot/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "model/error.hpp"
#include "plot/detail/gnuplot.hpp"
#include "plot/detail/sources.hpp"
#include "plot/detail/text.hpp"
#include "result/order_dataset.hpp"
#include "result/output_file.hpp"
#include "result/result_file.hpp"
#include "result/si_units.hpp"
#include "result/trace_file.hpp"

namespace gearsweep {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kScriptEnding = ".gp";

PlotScript script_of(const Page& page, const PlotRequest& request) {
  if (std::any_of(request.paths.begin(), request.paths.end(), is_order_file)) {
    request.style.refuse_band();
    return plot_orders(request);
  }
  if (!request.rays.empty()) throw InputError("--rays is for order maps");
  const auto traces = std::count_if(request.paths.begin(), request.paths.end(), is_trace_file);
  if (traces == 0) return plot_maps(page, request);
  if (traces == std::ssize(request.paths)) {
    request.style.refuse("contours", "it is for maps, not for traces");
    request.style.refuse_band();
    return plot_traces(page, request);
  }
  // What is neither says so itself.
  for (const std::string& path : request.paths) {
    if (!is_trace_file(path)) ResultFile{path};
  }
  throw InputError("some of the files hold maps and some traces; draw either by themselves");
}

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Whether a picture ends as its format does: gnuplot does not always say when a disk is full.
bool is_whole(const std::string& file, const std::string& name) {
  const std::string mark = name.ends_with(".png")   ? "IEND"
                           : name.ends_with(".pdf") ? "%%EOF"
                           : name.ends_with(".tex") ? "\\endgroup"
                                                    : "</svg>";
  const std::string content = content_of(file);
  return content.find(mark, content.size() - std::min<std::size_t>(content.size(), 32)) !=
         std::string::npos;
}

// Tells programs that place a PNG file how large it is: a pHYs chunk after the header, 300 dots per
// inch or 11811 per metre, with its check sum (PNG specification, 11.3.5.3).
void put_resolution(const std::string& file) {
  constexpr std::string_view kChunk(
      "\x00\x00\x00\x09pHYs\x00\x00\x2e\x23\x00\x00\x2e\x23\x01\x78\xa5\x3f\x76", 21);
  constexpr std::size_t kHeader = 33;  // the signature and the chunk IHDR
  std::string content = content_of(file);
  if (content.size() < kHeader || content.find("pHYs") < 100) return;
  content.insert(kHeader, kChunk);
  std::ofstream(file, std::ios::binary) << content;
}

// The lines before the picture's own: where its files are and where the picture goes. Whatever
// their names and whoever starts gnuplot, they begin with '/' or './' (see plain_path()).
//
// gnuplot's default encoding passes UTF-8 on as it is, in every locale. To set any other, this one
// too, makes gnuplot 5.4 complain where the locale is not UTF-8, so that is left to whoever has
// chosen another in an own ~/.gnuplot.
std::string preamble(const fs::path& script, const std::string& output, const Page& page,
                     const PlotScript& plotted) {
  const fs::path from_script = fs::absolute(output).lexically_relative(
      fs::absolute(script).lexically_normal().parent_path());
  return fmt::format(
      "# Given to gnuplot, this draws the picture again: gnuplot -c SCRIPT [PICTURE [DATA]]\n"
      "plain(path) = path[1:1] eq '/' ? path : './'.path\n"
      "script = plain(ARG0)\n"
      "do for [i = 1:strlen(script)] {{ if (script[i:i] eq '/') {{ folder = script[1:i] }} }}\n"
      "files = script[1:strlen(script) - 3]\n"
      "picture = ARGC > 0 ? plain(ARG1) : folder.{}\n"
      "data = ARGC > 1 ? plain(ARG2) : files.'.dat'\n"
      "if (GPVAL_ENCODING ne 'default' && GPVAL_ENCODING ne 'utf8') {{ set encoding utf8 }}\n{}{}"
      "set output picture\n",
      quote(from_script.string()), plotted.before, page.terminal(plotted.height));
}

constexpr std::string_view kTex = ".tex";

// The name of the image that LaTeX's picture includes; empty for other formats. Throws InputError
// where LaTeX would take the name for more than a name, and where the image would replace another
// picture.
std::string image_of(const std::string& output) {
  if (!output.ends_with(kTex)) return "";
  const std::string stem = fs::path(output).stem().string();
  const bool is_safe = std::all_of(stem.begin(), stem.end(), [](unsigned char letter) {
    return std::isalnum(letter) != 0 || letter == '-' || letter == '_' || letter == '.';
  });
  if (!is_safe || stem.empty()) {
    throw InputError(fmt::format(
        "cannot draw '{}': LaTeX includes it by its name, which may have letters, digits and - _ .",
        output));
  }
  const std::string image = output.substr(0, output.size() - kTex.size()) + ".pdf";
  if (fs::exists(image) && !fs::exists(output)) {
    throw InputError(fmt::format(
        "'{}' brings an image along, '{}', which exists and is another picture; it would be lost: "
        "give another name",
        output, image));
  }
  return image;
}

// LaTeX looks for the image in the folder of the document and where \graphicspath says. Of a
// picture in a folder below, `folder`, also there, while it reads the picture. Nothing where the
// document cannot be told the folder: a path that only this machine has, a name that LaTeX may not
// read as one.
void put_image_folder(const std::string& folder, std::string* text) {
  const bool is_safe = std::ranges::all_of(folder, [](unsigned char letter) {
    return std::isalnum(letter) != 0 || letter == '-' || letter == '_' || letter == '.' ||
           letter == '/';
  });
  if (folder.empty() || folder.front() == '/' || !is_safe) return;
  constexpr std::string_view kBegin = "\\makeatletter\n";  // the picture is a group of its own
  const std::size_t found = text->find(kBegin);
  if (found == std::string::npos) return;
  text->insert(found + kBegin.size(),
               fmt::format("  \\ifdefined\\Ginput@path\\else\\def\\Ginput@path{{}}\\fi\n"
                           "  \\expandafter\\def\\expandafter\\Ginput@path\\expandafter"
                           "{{\\Ginput@path{{{}/}}}}%\n",
                           folder));
}

// Where gnuplot plots, and what becomes of it.
class PictureFile {
 public:
  explicit PictureFile(const std::string& path)
      : path_(path), image_path_(image_of(path)), output_(path) {
    if (!image_path_.empty()) image_.emplace(image_path_);
  }

  // LaTeX's picture is plotted under its own name, since its text names the image.
  std::string place() const {
    if (!image_) return output_.temporary_path();
    return (folder_.path() / fs::path(path_).filename()).string();
  }

  void commit() {
    if (image_) {
      const std::string plotted = place();
      const std::string stem = plotted.substr(0, plotted.size() - kTex.size());
      std::string text = content_of(plotted);
      const std::string name = fs::path(stem).filename().string();
      for (std::size_t at = 0; (at = text.find(stem, at)) != std::string::npos;) {
        text.replace(at, stem.size(), name);
        at += name.size();
      }
      put_image_folder(fs::path(path_).parent_path().string(), &text);
      std::error_code told_below;
      fs::copy_file(stem + ".pdf", image_->temporary_path(), fs::copy_options::overwrite_existing,
                    told_below);
      std::ofstream(output_.temporary_path(), std::ios::binary) << text;
      ensure_whole(image_->temporary_path(), image_path_);
    }
    ensure_whole(output_.temporary_path(), path_);
    if (image_) image_->commit();
    output_.commit();
  }

 private:
  static void ensure_whole(const std::string& file, const std::string& name) {
    if (is_whole(file, name)) return;
    throw RunError(fmt::format("gnuplot wrote no whole picture for '{}'; is the disk full?", name));
  }

  std::string path_, image_path_;
  OutputFile output_;
  std::optional<OutputFile> image_;
  TemporaryFolder folder_;
};

}  // namespace

void ensure_plottable(const std::string& output_path) {
  picture_format(output_path);
  const std::string image = image_of(output_path);
  if (!image.empty()) ensure_writable(image);
  ensure_writable(output_path);
  ensure_gnuplot();
}

void plot_files(const PlotRequest& asked) {
  PlotRequest request = asked;
  if (!request.style.has_units) {
    request.style.is_si = std::ranges::all_of(
        request.paths, [](const std::string& path) { return scales_in(path).known(); });
  }
  const Page page(request.style, picture_format(request.output_path), usual_width(request));
  const bool keep_script = !request.script_path.empty();
  if (keep_script && !request.script_path.ends_with(kScriptEnding)) {
    throw InputError(
        fmt::format("cannot write the script '{}': its name must end in .gp", request.script_path));
  }
  PictureFile picture(request.output_path);
  if (keep_script) ensure_writable(request.script_path);
  const PlotScript plotted = script_of(page, request);

  const TemporaryFolder folder;
  const fs::path script = keep_script ? fs::path(request.script_path) : folder.path() / "plot.gp";
  const std::string stem = script.string();
  const std::string files = stem.substr(0, stem.size() - kScriptEnding.size());
  write_file(files + ".dat", plotted.data);
  if (!plotted.missing.empty()) write_file(files + "-missing.dat", plotted.missing);
  write_file(script.string(), preamble(script, request.output_path, page, plotted) + plotted.text);

  run_gnuplot(script.string(), picture.place());
  if (page.is_for_print() && request.output_path.ends_with(".png")) put_resolution(picture.place());
  picture.commit();
}

}  // namespace gearsweep
