#pragma once

/// The makers of the household objects. `edge` as in `HouseholdObject::make`, but unchecked.

#include <glissade/geometry/triangle_mesh.h>

namespace glissade::shapes {

// Tableware, about z.
geometry::TriangleMesh make_bottle(double edge);
geometry::TriangleMesh make_bowl(double edge);
geometry::TriangleMesh make_dinner_plate(double edge);
geometry::TriangleMesh make_egg(double edge);
geometry::TriangleMesh make_jar_lid(double edge);
geometry::TriangleMesh make_mug(double edge);
geometry::TriangleMesh make_wine_glass(double edge);

// Tools.
geometry::TriangleMesh make_door_handle(double edge);
geometry::TriangleMesh make_garden_hose(double edge);
geometry::TriangleMesh make_hammer(double edge);
geometry::TriangleMesh make_key(double edge);
geometry::TriangleMesh make_pen(double edge);
geometry::TriangleMesh make_scissors(double edge);
geometry::TriangleMesh make_screwdriver(double edge);

// Simple things.
geometry::TriangleMesh make_ball(double edge);
geometry::TriangleMesh make_book(double edge);
geometry::TriangleMesh make_card(double edge);
geometry::TriangleMesh make_carton(double edge);
geometry::TriangleMesh make_coin(double edge);
geometry::TriangleMesh make_die(double edge);
geometry::TriangleMesh make_paper(double edge);

}  // namespace glissade::shapes
