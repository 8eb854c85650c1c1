#include "kernels/leaf_frame.h"

#include "kernels/round_up.h"

namespace glissade::collision {

LeafFrame::LeafFrame(const QueryFrame& frame) {
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      matrix[row][column] = static_cast<float>(
          frame.ratio * frame.R_MN(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
    }
    p_MN[row] = static_cast<float>(frame.p_MN[static_cast<Eigen::Index>(row)]);
  }
  // By coordinate, in units of 2^-24, the spacing of single precision below 1. Corners lie within the unit sphere and
  // are rounded once: half a unit. For N this affects each coordinate, and a row of the rotation adds up √3 of it. Then
  // corners of N are multiplied by rounded factors (one unit of the length), products are rounded where there is no
  // fused multiplication (another unit), and they are summed in three steps to a rounded translation. A unit vector
  // adds up three coordinates (√3). A projection rounds three products and sums of either corner once more.
  const double reach = frame.p_MN.lpNorm<Eigen::Infinity>();
  const double corner_M = 0.5;
  const double corner_N = 6.0 * frame.ratio + 4.0 * reach;
  const double projections = 5.0 * (1.0 + frame.ratio + reach);
  corner_uncertainty = round_up_to_float(0x1p-24 * (corner_M + corner_N) + frame.uncertainty);
  edge_uncertainty_M = round_up_to_float(0x1p-24 * (2.0 * corner_M) + 2.0 * frame.uncertainty);
  uncertainty = round_up_to_float(1.75 * static_cast<double>(corner_uncertainty) + 0x1p-24 * 1.75 * projections +
                                  frame.uncertainty);
}

}  // namespace glissade::collision
