#pragma once

/// Access to the members of workspaces, for queries; users see only their counters.

#include <glissade/collision/query_types.h>

namespace glissade::collision {

struct WorkspaceAccess {
  static QueryMemory& memory(QueryWorkspace& workspace) { return *workspace.memory_; }
  static QueryWorkspace& scratch(CoherentWorkspace& workspace) { return workspace.workspace_; }
  static CoherentFront& front(CoherentWorkspace& workspace) { return *workspace.front_; }
};

inline QueryMemory& memory_of(QueryWorkspace& workspace) {
  return WorkspaceAccess::memory(workspace);
}

}  // namespace glissade::collision
