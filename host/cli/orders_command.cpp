// gearsweep orders: the spectrum of a channel over an axis.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "cli/commands.hpp"
#include "cli/detail/arguments.hpp"
#include "cli/detail/place_text.hpp"
#include "cli/detail/signal_watch.hpp"
#include "cli/detail/stop_on_signals.hpp"
#include "cli/detail/study_source.hpp"
#include "cli/standard_streams.hpp"
#include "model/error.hpp"
#include "model/names.hpp"
#include "model/version.hpp"
#include "orders/order_map.hpp"
#include "plot/plot.hpp"
#include "point/point_trace.hpp"
#include "result/order_dataset.hpp"

namespace gearsweep {
namespace {

struct OrderArguments {
  std::string study, output, picture;
  std::string over, channel, window = "none", rays, device;
  std::vector<std::string> at, overrides;
  std::optional<std::size_t> settle, record;
  std::size_t samples_per_period = 256;
  double orders = 10.0;
  bool is_upright_order = false;
  TableUnits units = TableUnits::model;
  bool has_units = false;  // they were asked for
  bool quiet = false;
};

std::string orders_command_line(const OrderArguments& arguments) {
  std::string line = "gearsweep orders " + shell_quoted(arguments.study);
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) line += fmt::format(" {} {}", option, shell_quoted(value));
  };
  add("--over", arguments.over);
  add("-q", arguments.channel);
  for (const std::string& point : arguments.at) add("--at", point);
  if (arguments.settle) line += fmt::format(" --settle {}", *arguments.settle);
  if (arguments.record) line += fmt::format(" --record {}", *arguments.record);
  line += fmt::format(" --samples-per-period {} --orders {:g}", arguments.samples_per_period,
                      arguments.orders);
  if (arguments.window != "none") add("--window", arguments.window);
  for (const std::string& text : arguments.overrides) add("--set", text);
  add("-o", arguments.output);
  return line;
}

Study load_lines(const OrderArguments& arguments) {
  Study study = with_windows(load_study(arguments.study, arguments.overrides),
                             {arguments.settle, arguments.record});
  if (!arguments.record) study.integrate.record = usual_order_record(study);
  settle_step(is_netcdf(arguments.study) ? read_pilot_step(arguments.study) : std::nullopt, &study);
  return study;
}

OrderRequest request_of(const OrderArguments& arguments, const Study& study) {
  OrderRequest request;
  request.over = arguments.over;
  std::vector<std::string> at;
  for (const std::string& point : arguments.at) {
    for (const std::string& one : split(point, ',')) at.push_back(one);
  }
  request.place = read_place(study, at);
  request.channel = arguments.channel;
  request.orders = arguments.orders;
  request.samples_per_period = arguments.samples_per_period;
  request.window = arguments.window == "hann" ? SpectrumWindow::hann : SpectrumWindow::none;
  return request;
}

void plot_orders(const OrderMap& map, const OrderArguments& arguments,
                 const Provenance& provenance) {
  const TemporaryFolder folder;
  PlotRequest plot;
  plot.paths = {(folder.path() / "orders.nc").string()};
  write_orders(map, plot.paths.front(), provenance);
  plot.quantity = arguments.is_upright_order ? "order" : "";
  plot.output_path = arguments.picture;
  plot.rays = arguments.rays;
  plot.style.has_units = arguments.has_units;
  plot.style.is_si = arguments.units == TableUnits::si;
  plot_files(plot);
  if (!arguments.quiet) tell("{}\n", arguments.picture);
}

int run_orders(const OrderArguments& arguments, SignalWatch* signals) {
  if (arguments.output.empty() && arguments.picture.empty()) {
    throw InputError("there is nothing to write: give -o OUT.nc, -o OUT.csv or --plot OUT.png");
  }
  const Study whole = load_lines(arguments);
  const OrderRequest request = request_of(arguments, whole);
  if (!arguments.output.empty()) {
    refuse_own_output(arguments.study, arguments.output);
    ensure_order_file(arguments.output, whole, arguments.units);
    ensure_writable(arguments.output);
  } else if (arguments.units == TableUnits::si && !whole.scales.known()) {
    throw InputError("--units SI: the study has no [gear] table, which gives the scales");
  }
  if (!arguments.picture.empty()) ensure_plottable(arguments.picture);
  SweepOptions options;
  options.devices = chosen_devices(arguments.device);
  options.stop = stop_on_signals(signals, arguments.quiet, options.scheduler);
  const std::optional<OrderMap> map = map_orders(whole, request, options);
  if (!map) return tell_interrupted();
  const Provenance provenance = {orders_command_line(arguments), version(), source_hash()};
  if (!arguments.output.empty()) {
    write_orders(*map, arguments.output, provenance, arguments.units);
    if (!arguments.quiet) {
      tell("{}: {} at {} values of {}, orders 0 to {:g} by 1/{:.0f}\n", arguments.output,
           map->channel.name, map->axis().values.size(), map->axis().name, map->orders.back(),
           1.0 / map->orders[1]);
    }
  }
  if (!arguments.picture.empty()) plot_orders(*map, arguments, provenance);
  return kDone;
}

constexpr const char* kOrdersFooter =
    "Examples:\n"
    "  gearsweep orders table1-gear --plot orders.png --units SI\n"
    "  gearsweep orders coarse-map --over omega --at e0=0.3 -q x1 -o orders.nc\n"
    "  gearsweep orders hysteresis --at e0=0.4 --set initial.policy=backward -o down.csv\n"
    "  gearsweep plot orders.nc -q order --orders 4 --rays 1,2,1/2 -o map.pdf --width 120mm\n\n"
    "Each value of the axis settles as [initial] says: on its own, or going on from its\n"
    "neighbour (forward, backward). White lines are natural frequencies of small motions about\n"
    "the static equilibrium with the mean mesh stiffness; where an order crosses one of them,\n"
    "the gear may resonate.";

// What each spectrum is taken of.
void add_spectrum_options(CLI::App* command, OrderArguments* arguments) {
  command
      ->add_option("--settle", arguments->settle,
                   "Mesh periods before, exactly so many, or up to a whole period of the forcing "
                   "(default: the study's, or fewer where the motion is periodic before)")
      ->type_name(kNumberValue)
      ->check(whole_number(0));
  command
      ->add_option(
          "--record", arguments->record,
          "Mesh periods of each spectrum, up to a whole period of the forcing (default: 48, whose "
          "orders are 1/48 apart)")
      ->type_name(kNumberValue)
      ->check(whole_number(1, 100000));
  command
      ->add_option("--samples-per-period", arguments->samples_per_period,
                   "Moments in each mesh period (default: 256); what is above half as many orders "
                   "comes down to lower ones, so take many")
      ->type_name(kNumberValue)
      ->check(whole_number(4, std::size_t{1} << 16U));
  command->add_option("--orders", arguments->orders, "The highest order (default: 10)")
      ->type_name(kNumberValue)
      ->check(positive_number());
  add_choice(command, "--window", &arguments->window, {"none", "hann"},
             "none (the default): exact lines of periodic motion, whose period divides the "
             "record; hann: less spreading of what is between the orders");
}

}  // namespace

void add_orders_command(CLI::App* app, SignalWatch* signals, int* status) {
  CLI::App* command = app->add_subcommand(
      "orders", "The spectrum of a channel over an axis: an order map, or Campbell diagram");
  const auto arguments = std::make_shared<OrderArguments>();
  add_study_argument(command, &arguments->study);
  command
      ->add_option("-o,--output", arguments->output,
                   "The numbers: .nc, .csv, or .uff for programs of modal analysis")
      ->type_name(kFileValue);
  command->add_option("--plot", arguments->picture, "The picture: .png, .svg, .pdf or .tex")
      ->type_name(kFileValue);
  command
      ->add_option("--over", arguments->over,
                   "The axis, such as the speed (default: the study's first)")
      ->type_name("AXIS");
  add_point_option(command, &arguments->at,
                   "Values of the study's other axis and of parameters (default: the study's own, "
                   "as without the axis)");
  command
      ->add_option("-q,--channel", arguments->channel,
                   "A state or signal of the model (default: the force between the teeth, else the "
                   "first state)")
      ->type_name("CHANNEL");
  add_spectrum_options(command, arguments.get());
  command
      ->add_option(
          "--rays", arguments->rays,
          "Orders that the picture has as lines: 1,2,1/2, of a second mesh 1:second, or none "
          "(default: 1,2,3,4 of each)")
      ->type_name("N,N/N,...");
  command->add_flag("--upright-orders", arguments->is_upright_order,
                    "The picture has orders on its vertical axis, not frequencies");
  add_units_option(command, &arguments->units);
  add_device_option(command, &arguments->device, false);
  add_set_option(command, &arguments->overrides);
  command->add_flag("--quiet", arguments->quiet, "No summary");
  command->footer(kOrdersFooter);
  command->callback([command, arguments, signals, status] {
    arguments->has_units = command->count("--units") > 0;
    *status = run_orders(*arguments, signals);
  });
}

}  // namespace gearsweep
