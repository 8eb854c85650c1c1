#pragma once

/// Reads kinematic chains from URDF files, the format of robot descriptions in ROS.

#include <filesystem>
#include <string>
#include <vector>

#include <glissade/grasping/kinematic_chain.h>

namespace glissade::grasping {

/// A chain, and warnings about skipped or missing content of its mesh files. Each warning is the name of the file,
/// followed by a sentence of `ImportedMesh::warnings`. No warning occurs twice.
struct UrdfChain {
  KinematicChain chain;
  std::vector<std::string> warnings;
};

/// Reads a robot as a chain. The root of the chain is the root link of the file. Each link comes before the links that
/// hang on it.
///
/// - Joints: `revolute` with its limits, `continuous` with limits of ±π, and `fixed`. Every `revolute` or `continuous`
///   joint without `<mimic>` gives a flex value with the name of the joint, in the order of the links.
/// - `<mimic>`: the joint turns with the value of the joint that it mimics, directly or through other mimics. Limits of
///   a joint with `<mimic>` are not used.
/// - Meshes: the collision geometry of a link, as one mesh. Boxes, cylinders and spheres become triangles. Mesh files
///   are read by `geometry::import_mesh`, with `scale`. The path of a mesh file is absolute, relative to the folder of
///   the URDF file, `file://`, or `package://NAME/PATH`. The folder of a package is the nearest folder NAME that
///   contains the URDF file, or whose parent folder contains this file.
///
/// Visual geometry, masses, dynamics and transmissions are ignored.
///
/// Throws std::invalid_argument, naming the file and the link or joint, in these cases: the file is missing or not well
/// formed; a joint is prismatic, floating or planar; the links do not form one tree; a limit, axis, size or scale is
/// invalid; a joint mimics a missing or fixed joint, or mimic joints form a cycle; or a mesh file cannot be found or
/// imported. May block on the disk.
UrdfChain read_urdf(const std::filesystem::path& path);

}  // namespace glissade::grasping
