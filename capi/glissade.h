#ifndef GLISSADE_GLISSADE_H
#define GLISSADE_GLISSADE_H

/** @file
 * Glissade in C: scenes, their simulation, and the haptic loop with gloves. C11; usable from C++ and, through P/Invoke,
 * from C#. docs/c.md shows how a game engine uses it.
 *
 * Units are SI: metres, kilograms, seconds, newtons, radians; times are nanoseconds. The world W of scenes is
 * right-handed, with z up. A part is an object that hands can hold. Its ghost is the pose that the part would have if
 * nothing were in the way. The visible part never enters another object.
 *
 * Status. Each function that can fail returns a status, and writes its results only if the status is GLISSADE_OK. No
 * exception leaves a function. glissade_last_error() has the sentence that names the wrong argument, key or value.
 *
 * Handles. A handle is a number that names an object of the library. A null handle, a handle of another kind, or a
 * handle whose object has been freed is an error, and never crashes the program. Objects may be freed in any order: a
 * server keeps its simulation and gloves, and the scene is copied. The caller owns every object that it makes, and
 * frees it once.
 *
 * Threads. Any thread may call any function. Calls on the same object wait for each other. There are two exceptions:
 * glissade_server_frame waits only while a frame is copied, and glissade_server_emergency_stop waits for no call.
 * Neither the haptic thread nor the simulation thread ever waits for a call. Arrays and texts that a caller passes are
 * read during the call only. */

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#error "Glissade runs on Linux."
#endif
#define GLISSADE_API __attribute__((visibility("default")))

#ifdef __cplusplus
extern "C" {
#endif

typedef enum GlissadeStatus {
  GLISSADE_OK = 0,
  GLISSADE_INVALID = 1, /**< an argument, a file or a handle is wrong: nothing has changed */
  GLISSADE_FAILED = 2   /**< a run has failed, or memory is used up */
} GlissadeStatus;

/** A null handle has the id 0. */
typedef struct GlissadeScene {
  uint64_t id;
} GlissadeScene;
typedef struct GlissadeSimulation {
  uint64_t id;
} GlissadeSimulation;
typedef struct GlissadeGlove {
  uint64_t id;
} GlissadeGlove;
typedef struct GlissadeServer {
  uint64_t id;
} GlissadeServer;

#define GLISSADE_JOINTS 22 /* of a hand, in CyberGlove order, see hands/hand.h */
#define GLISSADE_MAX_PARTS 4
#define GLISSADE_MAX_HANDS 4
#define GLISSADE_MAX_CONTACTS 24

/** The pose X_AB of a frame B in a frame A, usually the world: position in metres, and unit quaternion. A quaternion
 * whose length is off by more than 0.001 is an error. */
typedef struct GlissadePose {
  double x, y, z;
  double qw, qx, qy, qz;
} GlissadePose;

/** The version of the library, such as "0.1.0". */
GLISSADE_API const char* glissade_version(void);
/** The error message of this thread's last failed call; empty if none has failed. Valid until the next failure. */
GLISSADE_API const char* glissade_last_error(void);
/** The time of the haptic loop's clock, CLOCK_MONOTONIC. */
GLISSADE_API int64_t glissade_now_ns(void);

/* ---- Frames of game engines. Pure functions.
 * Unity: left-handed, x to the right, y up, z forwards, metres. Unreal: left-handed, x forwards, y to the right, z up,
 * centimetres. The world W has x forwards, y to the left and z up. */
typedef enum GlissadeEngine { GLISSADE_UNITY = 0, GLISSADE_UNREAL = 1 } GlissadeEngine;

/** Converts a pose in W to the frame of an engine, and back. Convert meshes by the same rule, each vertex as a
 * position. */
GLISSADE_API GlissadeStatus glissade_pose_to_engine(int32_t engine, const GlissadePose* pose, GlissadePose* out);
GLISSADE_API GlissadeStatus glissade_pose_from_engine(int32_t engine, const GlissadePose* pose, GlissadePose* out);
/** Converts a vector such as a force or a velocity to the axes of the engine, and back, without scaling. */
GLISSADE_API GlissadeStatus glissade_vector_to_engine(int32_t engine, const double vector[3], double out[3]);
GLISSADE_API GlissadeStatus glissade_vector_from_engine(int32_t engine, const double vector[3], double out[3]);
/** The same for a torque or an angular velocity. These axial vectors change their sign in a reflection. */
GLISSADE_API GlissadeStatus glissade_torque_to_engine(int32_t engine, const double torque[3], double out[3]);
GLISSADE_API GlissadeStatus glissade_torque_from_engine(int32_t engine, const double torque[3], double out[3]);

/* ---- Scenes. Objects are numbered in the order in which they are added. */

GLISSADE_API GlissadeStatus glissade_scene_new(GlissadeScene* scene);
/** Reads a scene file (docs/scene_files.md) and the meshes that it names. */
GLISSADE_API GlissadeStatus glissade_scene_read(const char* path, GlissadeScene* scene);
GLISSADE_API GlissadeStatus glissade_scene_free(GlissadeScene scene);

/** Adds an object that stands still at the pose X_WB; null is the identity. The mesh is in the object's frame B:
 * vertices as x, y, z one after the other (metres), and three indices for each triangle. Names must be unique. */
GLISSADE_API GlissadeStatus glissade_scene_add_mesh(GlissadeScene scene, const char* name, const double* vertices,
                                                    size_t vertex_count, const int32_t* triangles,
                                                    size_t triangle_count, const GlissadePose* X_WB);
/** Adds the mesh of a file (OBJ, STL, PLY, glTF) whose unit is `scale` metres, such as 0.001 for millimetres. */
GLISSADE_API GlissadeStatus glissade_scene_add_file(GlissadeScene scene, const char* name, const char* path,
                                                    double scale, const GlissadePose* X_WB);
/** Adds a shape of the catalogue in docs/scene_files.md, such as "box". Other parameters have their defaults. */
GLISSADE_API GlissadeStatus glissade_scene_add_shape(GlissadeScene scene, const char* name, const char* type,
                                                     const char* const* parameters, const double* values,
                                                     size_t parameter_count, const GlissadePose* X_WB);
/** Properties of an object that has been added or read: whether hands can hold it (1) or not (0); its pose; and, for a
 * fixed object, the gap (metres, at most 0.00025) at which it stops parts. */
GLISSADE_API GlissadeStatus glissade_scene_set_movable(GlissadeScene scene, const char* name, int is_movable);
GLISSADE_API GlissadeStatus glissade_scene_set_pose(GlissadeScene scene, const char* name, const GlissadePose* X_WB);
GLISSADE_API GlissadeStatus glissade_scene_set_margin(GlissadeScene scene, const char* name, double margin_m);

/** Adds a hand with fingers, for gloves that measure them. `length_m` is measured from the wrist to the tip of the
 * middle finger, `breadth_m` across the knuckles. 0 means that of a typical man. At most GLISSADE_MAX_HANDS. */
GLISSADE_API GlissadeStatus glissade_scene_add_hand(GlissadeScene scene, int is_left, double length_m,
                                                    double breadth_m);
/** Coulomb friction of all contacts: coefficients at rest, and while sliding (at most `at_rest`). 0 and 0: off. */
GLISSADE_API GlissadeStatus glissade_scene_set_friction(GlissadeScene scene, double at_rest, double sliding);
/** Stiffness of the spring between ghost and part. Default: 1000 N/m. A device that can only render less gets less. */
GLISSADE_API GlissadeStatus glissade_scene_set_stiffness(GlissadeScene scene, double stiffness_N_per_m);
/** Limits steps and work of each call, and uses a search thread: for scenes that a server runs. Keeps friction. */
GLISSADE_API GlissadeStatus glissade_scene_use_real_time_rules(GlissadeScene scene);

/** An object for a renderer. The pointers stay valid until the scene is changed or freed. */
typedef struct GlissadeObject {
  const char* name;
  GlissadePose X_WB; /**< at the start */
  int32_t is_movable;
  const double* vertices; /**< 3 for each vertex, metres, in the frame B of the object */
  size_t vertex_count;
  const int32_t* triangles; /**< 3 for each triangle */
  size_t triangle_count;
} GlissadeObject;

GLISSADE_API GlissadeStatus glissade_scene_object_count(GlissadeScene scene, size_t* count);
GLISSADE_API GlissadeStatus glissade_scene_object(GlissadeScene scene, size_t object, GlissadeObject* out);

/* ---- Simulation: the scene in motion, without devices. The caller advances it. Deterministic. Parts are numbered in
 * the order of the scene's movable objects. In the frames of a server, the objects that move on their own come next.
 * Bodies are numbered: first the fixed ones, then the parts, then the objects that move on their own. While a server
 * uses a simulation, a caller may ask only for its numbers and names. */

typedef enum GlissadePartState {
  GLISSADE_PART_UNKNOWN = 0,    /**< not yet reported */
  GLISSADE_PART_RELEASED = 1,   /**< no hand holds the part, and it stands still */
  GLISSADE_PART_FREE = 2,       /**< at its ghost */
  GLISSADE_PART_SLIDING = 3,    /**< contacts push, and it moves along them */
  GLISSADE_PART_RESTING = 4,    /**< contacts push, and it stands still */
  GLISSADE_PART_CATCHING_UP = 5 /**< no contact pushes, but it is not at its ghost yet */
} GlissadePartState;

typedef struct GlissadePart {
  GlissadePose X_WV;     /**< the visible part */
  GlissadePose X_WG;     /**< its ghost */
  int32_t state;         /**< GlissadePartState */
  int32_t contact_count; /**< contacts that push */
  double force_N[3];     /**< that contacts exert on the hands that hold the part, in world axes */
  double torque_Nm[3];   /**< about the part's compliance point (default: the middle of its bounding box), world axes */
} GlissadePart;

typedef struct GlissadeContact {
  int64_t id;        /**< stays the same while the contact lasts, if you ask for contacts after each call */
  int32_t body;      /**< number of the other body, see glissade_simulation_body_name */
  int32_t padding;   /**< 0 */
  double point_m[3]; /**< on the part, in the world */
  double normal[3];  /**< unit vector from the other body to the part */
  double gap_m;
  double force_N; /**< along the normal; 0 if the contact does not push */
} GlissadeContact;

/** Copies the scene, so that you may change or free it. Building the trees of its meshes takes most of the time. */
GLISSADE_API GlissadeStatus glissade_simulation_new(GlissadeScene scene, GlissadeSimulation* simulation);
GLISSADE_API GlissadeStatus glissade_simulation_free(GlissadeSimulation simulation);
/** Moves each part towards its ghost for this time, usually 1 ms. `ghosts` has a pose for each part that hands can
 * hold. For scenes without hands. */
GLISSADE_API GlissadeStatus glissade_simulation_advance(GlissadeSimulation simulation, const GlissadePose* ghosts,
                                                        size_t ghost_count, double milliseconds);
GLISSADE_API GlissadeStatus glissade_simulation_part_count(GlissadeSimulation simulation, size_t* count);
/** The number of the part with this name. */
GLISSADE_API GlissadeStatus glissade_simulation_find_part(GlissadeSimulation simulation, const char* name,
                                                          size_t* part);
GLISSADE_API GlissadeStatus glissade_simulation_part(GlissadeSimulation simulation, size_t part, GlissadePart* out);
/** Writes the first `capacity` touching contacts of the part, and the number of all its touching contacts. */
GLISSADE_API GlissadeStatus glissade_simulation_contacts(GlissadeSimulation simulation, size_t part,
                                                         GlissadeContact* contacts, size_t capacity, size_t* count);
/** The distance (metres) from the part to the nearest other body. Costs one query for each body. */
GLISSADE_API GlissadeStatus glissade_simulation_clearance(GlissadeSimulation simulation, size_t part,
                                                          double* clearance_m);
/** The name of a body. Valid until the simulation and all servers that use it have been freed. */
GLISSADE_API GlissadeStatus glissade_simulation_body_name(GlissadeSimulation simulation, int32_t body,
                                                          const char** name);

/* ---- Gloves. A glove is used by one server at a time. */

/** Bits of `reasons`: why a force is less than the contacts demand. The first seven let the force fade to zero. */
typedef enum GlissadeReason {
  GLISSADE_REASON_STOPPED = 1 << 0,         /**< emergency stop, or the loop has ended */
  GLISSADE_REASON_DISABLED = 1 << 1,        /**< the wearer does not hold the enable switch */
  GLISSADE_REASON_REFUSED = 1 << 2,         /**< the glove refuses this server */
  GLISSADE_REASON_NOT_FINITE = 1 << 3,      /**< a number is not finite */
  GLISSADE_REASON_IMPLAUSIBLE = 1 << 4,     /**< a state contradicts the device or earlier states */
  GLISSADE_REASON_STATE_OLD = 1 << 5,       /**< the newest state was measured too long ago */
  GLISSADE_REASON_COMMAND_OLD = 1 << 6,     /**< the command answers an old state, or none */
  GLISSADE_REASON_RETURNING = 1 << 7,       /**< the force returns softly after the start or a reason above */
  GLISSADE_REASON_FORCE_LIMITED = 1 << 8,   /**< by max_force_N */
  GLISSADE_REASON_TORQUE_LIMITED = 1 << 9,  /**< by max_torque_Nm */
  GLISSADE_REASON_JOINTS_LIMITED = 1 << 10, /**< by max_joint_torque_Nm */
  GLISSADE_REASON_RATE_LIMITED = 1 << 11,   /**< by the largest rates of force and torque */
  GLISSADE_REASON_POWER_LIMITED = 1 << 12,  /**< by max_power_W */
  GLISSADE_REASON_MEAN_LIMITED = 1 << 13,   /**< by max_mean_force_N */
  GLISSADE_REASON_ENERGY_LIMITED = 1 << 14  /**< by the energy that is left, see docs/safety.md */
} GlissadeReason;

/** Capabilities and limits of a device; see devices/glove_device.h. 0 means that the device exerts no such force, or
 * that the value is not known. Required: max_stiffness_N_per_m and max_rotational_stiffness_Nm_per_rad. */
typedef struct GlissadeDevice {
  double max_force_N, max_torque_Nm, max_joint_torque_Nm;
  double max_power_W;      /**< that force and torque put into the hand; 50 by default */
  double max_mean_force_N; /**< over about ten seconds; 0: max_force_N */
  double max_force_rate_N_per_s, max_torque_rate_Nm_per_s, max_joint_torque_rate_Nm_per_s; /**< 0: the usual rates */
  double max_damping_Ns_per_m;
  double max_stiffness_N_per_m, max_rotational_stiffness_Nm_per_rad;
  double damping_Ns_per_m, rotational_damping_Nms_per_rad, joint_damping_Nms_per_rad; /**< of the bare device */
  double friction_N, joint_friction_Nm;                                               /**< of the bare device */
  double resolution_m, joint_resolution_rad; /**< steps or noise of the measurements */
  double update_rate_Hz;                     /**< calls of glissade_glove_command a second, 1 to 100000 */
  double delay_s;                            /**< from measurement to force, in addition to the period */
  double frozen_s;                           /**< longest time with a bit-identical pose; 0: not checked */
  double max_speed_m_per_s, max_turn_rate_rad_per_s, workspace_radius_m;     /**< more is a tracker error */
  double joint_lower_rad[GLISSADE_JOINTS], joint_upper_rad[GLISSADE_JOINTS]; /**< both 0: there is no such joint */
} GlissadeDevice;

/** A device without force at 1000 Hz, with the usual limits of a tracker. */
GLISSADE_API GlissadeStatus glissade_device_default(GlissadeDevice* device);

typedef struct GlissadeGloveState {
  int64_t time_ns;   /**< of the measurement, on any monotonic clock, such as glissade_now_ns */
  GlissadePose X_WH; /**< of the hand root */
  double velocity_m_per_s[3], angular_velocity_rad_per_s[3]; /**< of the hand root, in world axes */
  double joint_angles_rad[GLISSADE_JOINTS];
  int64_t grip;       /**< number of times that the hand has closed or opened: odd while it is closed */
  int32_t is_enabled; /**< 0: the wearer does not hold the enable switch, so there is no force */
  int32_t padding;    /**< 0 */
} GlissadeGloveState;

/** A closed, enabled hand at the origin. */
GLISSADE_API GlissadeStatus glissade_glove_state_default(GlissadeGloveState* state);

typedef struct GlissadeGloveCommand {
  double force_N[3];   /**< on the hand at the hand root, in world axes */
  double torque_Nm[3]; /**< about the hand root, in world axes */
  double joint_torques_Nm[GLISSADE_JOINTS];
  int32_t reasons; /**< why the command is less than wanted: bits of GlissadeReason */
  int32_t padding; /**< 0 */
  int64_t age_ns;  /**< time since the measurement of the state that the command answers */
} GlissadeGloveCommand;

/** A glove whose driver is the caller. `name` is for messages. */
GLISSADE_API GlissadeStatus glissade_glove_new(const char* name, const GlissadeDevice* device, GlissadeGlove* glove);
/** A simulated glove and its wearer, in a separate thread. The hand follows the poses X_WH at `times_s` (ascending),
 * and yields to the force. It waits at the first pose until a server runs. The glove exerts up to 20 N and 1 Nm, at
 * 1000 Hz. */
GLISSADE_API GlissadeStatus glissade_glove_new_simulated(const double* times_s, const GlissadePose* X_WH, size_t count,
                                                         GlissadeGlove* glove);
GLISSADE_API GlissadeStatus glissade_glove_free(GlissadeGlove glove);
/** Driver: passes on the newest state. Call this function once for each measurement. */
GLISSADE_API GlissadeStatus glissade_glove_put(GlissadeGlove glove, const GlissadeGloveState* state);
/** Driver: the command that the device must execute now. Call this function once a period, after glissade_glove_put.
 * The force fades to zero if states stop, or if the server is late, stops or ends. If the driver itself halts, only the
 * device's watchdog ends the force (docs/safety.md). For a simulated glove: the command that it executes. Any thread
 * may ask for it. */
GLISSADE_API GlissadeStatus glissade_glove_command(GlissadeGlove glove, GlissadeGloveCommand* command);
/** Writes the most serious reason as a sentence, cut to `capacity` bytes including the final 0. No reason gives "". */
GLISSADE_API GlissadeStatus glissade_reason_text(int32_t reasons, int64_t age_ns, char* text, size_t capacity);

/* ---- The haptic loop: forces at 1000 Hz in one thread, the simulation in another. */

typedef struct GlissadeHandFrame {
  int32_t part;                   /**< number of the part that the hand holds, or -1 */
  int32_t reasons;                /**< why the loop sent less than the contacts demand: bits of GlissadeReason */
  int32_t glove_reasons, padding; /**< why the glove exerts less than the loop sent */
  double force_N[3],
      torque_Nm[3]; /**< that the loop sent, in world axes; the torque about the origin of the held part */
  double energy_J;  /**< that force and torque may still give to the hand */
  /** Of a hand with fingers: the visible hand, which enters no object. */
  GlissadePose X_WH;
  double joint_angles_rad[GLISSADE_JOINTS];
  int32_t activity; /**< 0: no fingers, 1: lost, 2: waits inside an object, 3: free, 4: holds */
  int32_t grasp;    /**< 0: none, 1: push, 2: precision, 3: power */
} GlissadeHandFrame;

typedef struct GlissadePartFrame {
  GlissadePose X_WV, X_WG;
  int32_t state; /**< GlissadePartState */
  int32_t contact_count;
} GlissadePartFrame;

typedef struct GlissadeFrameContact {
  int32_t part, padding;
  double point_m[3], normal[3]; /**< in the world; from the obstacle to the part */
} GlissadeFrameContact;

/** The state after one tick of the haptic thread. All fields belong to this tick. */
typedef struct GlissadeFrame {
  int64_t tick;    /**< 0 before the first one */
  int64_t time_ns; /**< on the clock of glissade_now_ns */
  int32_t part_count, hand_count, contact_count, padding;
  GlissadePartFrame parts[GLISSADE_MAX_PARTS];
  GlissadeHandFrame hands[GLISSADE_MAX_HANDS];
  GlissadeFrameContact contacts[GLISSADE_MAX_CONTACTS]; /**< that push */
} GlissadeFrame;

typedef struct GlissadeStatistics {
  int64_t ticks, late_ticks; /**< late: by a period or more */
  int32_t has_real_time_priority, has_locked_memory;
} GlissadeStatistics;

/** Starts the loop with these gloves. The gloves of the scene's hands come first. A hand without fingers takes the
 * first part if its glove is closed at the start. Later, its grip decides. Use glissade_scene_use_real_time_rules. */
GLISSADE_API GlissadeStatus glissade_server_start(GlissadeSimulation simulation, const GlissadeGlove* gloves,
                                                  size_t glove_count, GlissadeServer* server);
/** Lets the forces fade, and ends the loop. May take some ticks. Then the gloves and the simulation are free again. */
GLISSADE_API GlissadeStatus glissade_server_stop(GlissadeServer server);
/** Frees the server, and first stops it if it runs. */
GLISSADE_API GlissadeStatus glissade_server_free(GlissadeServer server);
/** Returns GLISSADE_FAILED if the loop has failed. The last error is then the reason, and the forces have faded. */
GLISSADE_API GlissadeStatus glissade_server_check(GlissadeServer server);
/** The newest frame, for a renderer at its own rate. Never waits for the loop. A loop that has failed
 * (glissade_server_check) makes no new frames. After glissade_server_stop, the last frame shows no force. */
GLISSADE_API GlissadeStatus glissade_server_frame(GlissadeServer server, GlissadeFrame* frame);
GLISSADE_API GlissadeStatus glissade_server_statistics(GlissadeServer server, GlissadeStatistics* statistics);
/** The hand takes this part, or lets go of its part, in the next tick. For hands without fingers. */
GLISSADE_API GlissadeStatus glissade_server_grasp(GlissadeServer server, size_t hand, size_t part);
GLISSADE_API GlissadeStatus glissade_server_release(GlissadeServer server, size_t hand);
/** All forces fade to zero and stay there, but the loop goes on. */
GLISSADE_API GlissadeStatus glissade_server_emergency_stop(GlissadeServer server);

#ifdef __cplusplus
}
#endif

#endif /* GLISSADE_GLISSADE_H */
