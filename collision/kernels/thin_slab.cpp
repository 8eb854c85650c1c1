#include "kernels/thin_slab.h"

#include "kernels/round_up.h"
#include "tree/dop_node.h"

namespace glissade::collision {

ThinSlabFrame::ThinSlabFrame(const QueryFrame& frame) {
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t column = 0; column < 3; ++column) {
      R_MN[row][column] =
          static_cast<float>(frame.R_MN(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(column)));
    }
    p_MN[row] = static_cast<float>(kGridRadius * frame.p_MN[static_cast<Eigen::Index>(row)]);
  }
  ratio = round_up_to_float(frame.ratio);
  // Rounding in single precision: differences of coordinates of at most this size, their three products with the
  // components of a normal, and a dozen further operations. Each rounding is at most 2^-24 of it.
  const double largest = kGridRadius * (1.0 + frame.ratio + frame.p_MN.norm());
  padding = round_up_to_float(0x1p-24 * 64.0 * largest + 4.0 * kGridRadius * frame.uncertainty);
}

}  // namespace glissade::collision
