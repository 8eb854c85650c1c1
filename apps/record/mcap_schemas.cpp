#include <string>

#include <glissade/apps/record/mcap_schemas.h>
#include <glissade/devices/glove_device.h>

namespace glissade::apps {

namespace {

using Json = nlohmann::json;

Json of_type(const char* type, const std::string& description) {
  return {{"type", type}, {"description", description}};
}

Json number(const std::string& description) {
  return of_type("number", description);
}

Json integer(const std::string& description) {
  return of_type("integer", description);
}

Json words(const std::string& description) {
  return of_type("string", description);
}

Json truth(const std::string& description) {
  return of_type("boolean", description);
}

Json object(const std::string& title, Json properties) {
  return {{"type", "object"}, {"title", title}, {"properties", std::move(properties)}};
}

Json list(Json items) {
  return {{"type", "array"}, {"items", std::move(items)}};
}

Json numbers(const std::string& title, const std::string& names, const std::string& description) {
  Json properties = Json::object();
  for (const char name : names)
    properties[std::string(1, name)] = of_type("number", description);
  return object(title, std::move(properties));
}

Json vector(const std::string& description) {
  return numbers("vector", "xyz", description);
}

Json time(const char* title) {
  return object(title, {{"sec", integer("seconds")}, {"nsec", integer("nanoseconds, below 1e9")}});
}

Json position() {
  return numbers("foxglove.Vector3", "xyz", "m");
}

Json orientation() {
  return numbers("foxglove.Quaternion", "xyzw", "of a unit quaternion");
}

Json pose() {
  return object("foxglove.Pose", {{"position", position()}, {"orientation", orientation()}});
}

Json color() {
  return numbers("foxglove.Color", "rgba", "0 to 1");
}

Json triangles() {
  return object("foxglove.TriangleListPrimitive",
                {{"pose", pose()},
                 {"points", list(numbers("foxglove.Point3", "xyz", "m"))},
                 {"color", color()},
                 {"colors", list(color())},
                 {"indices", list(integer("number of a point; three make a triangle"))}});
}

Json arrows() {
  return object(
      "foxglove.ArrowPrimitive",
      {{"pose", pose()},
       {"shaft_length", number("m, along the x axis of the pose; shaft and head of a force: 10 mm for each newton")},
       {"shaft_diameter", number("m")},
       {"head_length", number("m")},
       {"head_diameter", number("m")},
       {"color", color()}});
}

Json spheres() {
  return object("foxglove.SpherePrimitive", {{"pose", pose()}, {"size", position()}, {"color", color()}});
}

Json texts() {
  return object("foxglove.TextPrimitive", {{"pose", pose()},
                                           {"billboard", truth("the text faces who looks at it")},
                                           {"font_size", number("pixels, because the size does not depend on the eye")},
                                           {"scale_invariant", truth("the size does not depend on the eye")},
                                           {"color", color()},
                                           {"text", words("name of the object")}});
}

Json joints(const std::string& ending, const std::string& description) {
  Json properties = Json::object();
  for (const std::string_view name : hands::kJointNames)
    properties[std::string(name) + ending] = number(description);
  return object("joints", std::move(properties));
}

}  // namespace

Json frame_transforms_schema() {
  Json transform{{"timestamp", time("time")},
                 {"parent_frame_id", words("frame")},
                 {"child_frame_id", words("frame, whose pose in the parent this is")},
                 {"translation", position()},
                 {"rotation", orientation()}};
  return object("foxglove.FrameTransforms",
                {{"transforms", list(object("foxglove.FrameTransform", std::move(transform)))}});
}

Json scene_update_schema() {
  Json entity{{"timestamp", time("time")},
              {"frame_id", words("frame in which the entity stands")},
              {"id", words("name of the entity, in the place of the last one of this name")},
              {"lifetime", time("duration")},
              {"frame_locked", truth("the entity follows its frame")},
              {"metadata", list(object("foxglove.KeyValuePair", {{"key", words("key")}, {"value", words("value")}}))},
              {"triangles", list(triangles())},
              {"arrows", list(arrows())},
              {"spheres", list(spheres())},
              {"texts", list(texts())}};
  for (const char* unused : {"cubes", "cylinders", "lines", "models"})
    entity[unused] = list(object(unused, Json::object()));
  Json deletion{{"timestamp", time("time")},
                {"type", integer("0: the entity with this name; 1: all")},
                {"id", words("name of the entity")}};
  return object("foxglove.SceneUpdate",
                {{"deletions", list(object("foxglove.SceneEntityDeletion", std::move(deletion)))},
                 {"entities", list(object("foxglove.SceneEntity", std::move(entity)))}});
}

Json loop_schema() {
  return object("glissade.Loop", {{"tick", integer("number of the tick")},
                                  {"lateness_s", number("delay of the start after its deadline")},
                                  {"duration_s", number("until the commands were handed over; 0 offline")},
                                  {"contact_set", integer("number of the newest contact set")},
                                  {"requests", integer("grasps and releases that the program asked for")},
                                  {"stopped", truth("the force was stopped")}});
}

Json part_schema() {
  return object("glissade.Part", {{"tick", integer("number of the tick")},
                                  {"state", words("state of the part")},
                                  {"contacts", integer("contacts that push")},
                                  {"position_m", vector("of the visible part, in the world")},
                                  {"ghost_position_m", vector("of the ghost, in the world")},
                                  {"lag_m", number("distance from the visible part to its ghost")},
                                  {"lag_rad", number("angle from the visible part to its ghost")},
                                  {"age_s", number("time since the ghost poses that the contacts answer")}});
}

Json hand_schema() {
  return object(
      "glissade.Hand",
      {{"tick", integer("number of the tick")},
       {"part", integer("number of the part that it holds; -1: none")},
       {"force_N", vector("force on the hand, in world axes")},
       {"torque_Nm", vector("torque on the hand about the origin of the part, in world axes")},
       {"contact_share", number("share of the contacts' force that is exerted")},
       {"state_age_s", number("time since the measurement of the glove's state")},
       {"command_age_s", number("age of the command at the glove")},
       {"energy_J",
        number("energy left to the hand, by the passivity observer that acts: the glove's, if it tells of one")},
       {"reason", words("why there is no force or less; empty if there is no reason")},
       {"activity", words("what a hand with fingers does")},
       {"grasp", words("kind of the grasp")},
       {"grasp_reason", words("kind and form of the grasp, and the segments that touch")},
       {"angles_rad", joints("_rad", "of the visible hand")},
       {"torques_Nm", joints("_Nm", "as the device got it")}});
}

}  // namespace glissade::apps
