// Files of order maps: NetCDF-4, or CSV and universal files to be read elsewhere.
#pragma once

#include <string>
#include <vector>

#include "model/exciting_meshes.hpp"
#include "result/dataset.hpp"
#include "result/result_file.hpp"
#include "result/table_units.hpp"

namespace gearsweep {

struct OrderMap;

// Along the axis, by its name: `forcing_frequency` of order 1, `mean` of the channel, `amplitude`
// (axis, order), `natural_frequency` and `damping_ratio` (axis, mode). The map must outlive it.
Dataset dataset_of(const OrderMap& map, const Provenance& provenance);

// Hz in the unit of frequency, rad per dimensionless time; 0 without scales.
double hertz_per_unit(const Scales& scales);

// Throws InputError unless the name ends in .nc, .csv or .uff, or when such a file of the study
// cannot have these units.
void ensure_order_file(const std::string& path, const Study& study, TableUnits units);

// A table has a row for each value of the axis and each order: frequency, amplitude and decibels.
// In SI units frequencies are in Hz. A universal file has the amplitudes over the order, a dataset
// 58 for each value of the axis. Throws as write_result().
void write_orders(const OrderMap& map, const std::string& path, const Provenance& provenance,
                  TableUnits units = TableUnits::model);

// An order map as a file has it.
struct StoredOrders {
  std::string title, settings;
  Scales scales;
  ResultAxis axis;
  ChannelInfo channel;
  std::string frequency_unit;
  std::string order_of;                          // "mesh" or "forcing"
  std::vector<ExcitingMesh> meshes;              // that of the phase first
  std::vector<double> orders, forcing;           // [order], [point]
  std::vector<double> amplitude;                 // [point][order]
  std::vector<std::vector<double>> frequencies;  // [mode][point] natural ones; NaN: none
};

bool is_order_file(const std::string& path);

// Throws InputError when it is none.
StoredOrders read_orders(const std::string& path);

}  // namespace gearsweep
