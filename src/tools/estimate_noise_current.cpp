// Noise current of a triangulation sensor from the spread of repeated readings (pears eq. 2).
#include <fmt/format.h>

#include "program/program.h"
#include "sightline/triangulation/noise_current.h"

namespace {

using namespace sightline;

int estimate(const std::string& file, double detector_length) {
  if (!(detector_length > 0.0)) throw tools::UsageError("--detector-length has to be above 0");
  const auto table = config::CsvTable::readFile(file);
  const auto found =
      triangulation::estimateNoiseCurrent(triangulation::readSpreads(table), table.source());
  const double to_um_nA = 1e15;
  fmt::print("noise_current {:.4g} A +- {:.2g}\n", found.noiseCurrent(detector_length),
             found.noiseCurrentSigma(detector_length));
  fmt::print("product {:.1f} um nA +- {:.1f}\n", to_um_nA * found.product,
             to_um_nA * found.product_sigma);
  fmt::print("free slope {:.3f} +- {:.3f}, product at 1 nA {:.1f} um nA (eq. 2 says -1)\n",
             found.free_slope, found.free_slope_sigma, to_um_nA * found.free_product);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  std::string file;
  double detector_length = 0.010;
  tools::Program program("estimate_noise_current",
                         "Noise current of a triangulation sensor, by least squares on logarithms "
                         "with the slope of pears eq. 2.");
  program.positional("FILE.csv", file,
                     "columns current_A and image_sigma_m, or current_nA and image_sigma_um: mean "
                     "current and standard deviation of image position, one target a line");
  program.option("--detector-length", detector_length, "METRES", "P of pears eq. 1; default 0.010");
  return program.run(argc, argv, [&] { return estimate(file, detector_length); });
}
