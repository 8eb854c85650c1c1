#pragma once

/// Rows of contacts where a displacement leads. A row holds to first order: on the way, normals turn with the bodies
/// and points go round. With the rows at the end of a displacement, a second projection finds the step that several
/// small ones would make, without another search for contacts.

#include <span>
#include <vector>

#include <glissade/contact/projection.h>
#include <glissade/contact/sliding_result.h>

#include "cycle/simulated_parts.h"

namespace glissade::contact {

/// Not thread-safe.
class TurnedRows {
 public:
  /// `shared` must outlive this object.
  explicit TurnedRows(const SimulatedParts& shared) : shared_(shared) {}

  /// The `rows` of `contacts`, one for each, after displacements of the parts: their constraints on further ones, which
  /// together with the first leave the gaps that the rows demand. Vertices stay over their faces and edges past each
  /// other, however far the displacement leads. The normal of a vertex beside an edge or a vertex stands still, as does
  /// that of edges that are almost parallel. Valid until the next call.
  std::span<const CoupledRow> find(const Displacements& displacements, std::span<const CoupledRow> rows,
                                   std::span<const Contact> contacts);

 private:
  const SimulatedParts& shared_;
  std::vector<CoupledRow> rows_;
};

}  // namespace glissade::contact
