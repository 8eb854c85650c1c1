#include <glissade/base/require.h>
#include <glissade/shapes/household_objects.h>

#include "household/household_shapes.h"

namespace glissade::shapes {
namespace {

template <geometry::TriangleMesh (*kMake)(double)>
geometry::TriangleMesh checked(double edge) {
  base::require_between("edge", edge, 0.5e-3, 20e-3);
  return kMake(edge);
}

}  // namespace

const std::vector<HouseholdObject>& household_objects() {
  static const std::vector<HouseholdObject> kObjects{
      {"ball", "ball of 66 mm about the origin", &checked<&make_ball>},
      {"book", "book of 150 × 215 × 22 mm about the origin", &checked<&make_book>},
      {"bottle", "closed bottle about z, 70 mm wide and 230 mm high", &checked<&make_bottle>},
      {"bowl", "bowl about z, 144 mm wide and 60 mm high", &checked<&make_bowl>},
      {"card", "bank card about the origin, across z", &checked<&make_card>},
      {"carton", "carton of 62 × 95 × 40 mm about the origin", &checked<&make_carton>},
      {"coin", "coin of 25 mm about the origin, across z", &checked<&make_coin>},
      {"die", "rounded cube of 16 mm about the origin", &checked<&make_die>},
      {"dinner_plate", "dinner plate about z, 260 mm wide", &checked<&make_dinner_plate>},
      {"door_handle", "lever along x on its spindle, 52 mm from a door at z = 0", &checked<&make_door_handle>},
      {"egg", "egg of 56 mm along z about the origin", &checked<&make_egg>},
      {"garden_hose", "piece of a hose of 22 mm, bent in the plane y = 0", &checked<&make_garden_hose>},
      {"hammer", "hammer with its handle along z, the head at z = 180 mm", &checked<&make_hammer>},
      {"jar_lid", "lid of a jar about z, 60 mm wide and 12 mm high", &checked<&make_jar_lid>},
      {"key", "key across z, its bow about the origin and its blade along x", &checked<&make_key>},
      {"mug", "mug about z, 82 mm wide and 95 mm high, its handle on the x axis", &checked<&make_mug>},
      {"paper", "bent sheet of paper of 148 × 105 mm without thickness", &checked<&make_paper>},
      {"pen", "pen of 9 mm along z, its point at the origin", &checked<&make_pen>},
      {"scissors", "closed scissors across z, the pivot at the origin", &checked<&make_scissors>},
      {"screwdriver", "screwdriver along z, its handle of 33 mm from the origin to z = 106 mm",
       &checked<&make_screwdriver>},
      {"wine_glass", "wine glass about z, 76 mm wide and 185 mm high", &checked<&make_wine_glass>}};
  return kObjects;
}

}  // namespace glissade::shapes
