#include "cli/device_option.hpp"

namespace gearsweep {

void add_device_option(CLI::App* command, std::string* text, bool several) {
  command->add_option("--device", *text,
                      several ? "Numbers of 'gearsweep devices' that share the work: 0,1 or all "
                                "('0/2': the halves of device 0; '0,0': two tiles at a time)"
                              : "A number of 'gearsweep devices'");
}

std::vector<DeviceChoice> chosen_devices(const std::string& text) {
  if (text.empty()) return {};
  return parse_devices(text, list_devices());
}

}  // namespace gearsweep
