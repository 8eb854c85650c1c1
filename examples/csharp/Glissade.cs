// The C interface of Glissade for C# (.NET, Mono, Unity): the declarations of glissade.h, which documents them. All
// numbers, units and orders are those of the header; size_t is ulong. An array of one, or null, stands for a pose that
// may be null.
using System;
using System.Runtime.InteropServices;

public enum GlissadeStatus { Ok = 0, Invalid = 1, Failed = 2 }

public enum GlissadeEngine { Unity = 0, Unreal = 1 }

public enum GlissadePartState { Unknown = 0, Released = 1, Free = 2, Sliding = 3, Resting = 4, CatchingUp = 5 }

[Flags]
public enum GlissadeReason {
  Stopped = 1 << 0, Disabled = 1 << 1, Refused = 1 << 2, NotFinite = 1 << 3, Implausible = 1 << 4, StateOld = 1 << 5,
  CommandOld = 1 << 6, Returning = 1 << 7, ForceLimited = 1 << 8, TorqueLimited = 1 << 9, JointsLimited = 1 << 10,
  RateLimited = 1 << 11, PowerLimited = 1 << 12, MeanLimited = 1 << 13, EnergyLimited = 1 << 14
}

[StructLayout(LayoutKind.Sequential)] public struct GlissadeScene { public ulong id; }
[StructLayout(LayoutKind.Sequential)] public struct GlissadeSimulation { public ulong id; }
[StructLayout(LayoutKind.Sequential)] public struct GlissadeGlove { public ulong id; }
[StructLayout(LayoutKind.Sequential)] public struct GlissadeServer { public ulong id; }

[StructLayout(LayoutKind.Sequential)]
public struct GlissadePose {
  public double x, y, z, qw, qx, qy, qz;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadeObject {
  public IntPtr name;
  public GlissadePose X_WB;
  public int is_movable;
  public IntPtr vertices;
  public ulong vertex_count;
  public IntPtr triangles;
  public ulong triangle_count;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadePart {
  public GlissadePose X_WV, X_WG;
  public int state, contact_count;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] force_N, torque_Nm;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadeContact {
  public long id;
  public int body, padding;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] point_m, normal;
  public double gap_m, force_N;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadeDevice {
  public double max_force_N, max_torque_Nm, max_joint_torque_Nm;
  public double max_power_W, max_mean_force_N;
  public double max_force_rate_N_per_s, max_torque_rate_Nm_per_s, max_joint_torque_rate_Nm_per_s;
  public double max_damping_Ns_per_m;
  public double max_stiffness_N_per_m, max_rotational_stiffness_Nm_per_rad;
  public double damping_Ns_per_m, rotational_damping_Nms_per_rad, joint_damping_Nms_per_rad;
  public double friction_N, joint_friction_Nm;
  public double resolution_m, joint_resolution_rad;
  public double update_rate_Hz, delay_s, frozen_s;
  public double max_speed_m_per_s, max_turn_rate_rad_per_s, workspace_radius_m;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = Glissade.Joints)] public double[] joint_lower_rad, joint_upper_rad;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadeGloveState {
  public long time_ns;
  public GlissadePose X_WH;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] velocity_m_per_s, angular_velocity_rad_per_s;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = Glissade.Joints)] public double[] joint_angles_rad;
  public long grip;
  public int is_enabled, padding;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadeGloveCommand {
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] force_N, torque_Nm;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = Glissade.Joints)] public double[] joint_torques_Nm;
  public int reasons, padding;
  public long age_ns;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadeHandFrame {
  public int part, reasons, glove_reasons, padding;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] force_N, torque_Nm;
  public double energy_J;
  public GlissadePose X_WH;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = Glissade.Joints)] public double[] joint_angles_rad;
  public int activity, grasp;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadePartFrame {
  public GlissadePose X_WV, X_WG;
  public int state, contact_count;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadeFrameContact {
  public int part, padding;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = 3)] public double[] point_m, normal;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadeFrame {
  public long tick, time_ns;
  public int part_count, hand_count, contact_count, padding;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)] public GlissadePartFrame[] parts;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = 4)] public GlissadeHandFrame[] hands;
  [MarshalAs(UnmanagedType.ByValArray, SizeConst = 24)] public GlissadeFrameContact[] contacts;
}

[StructLayout(LayoutKind.Sequential)]
public struct GlissadeStatistics {
  public long ticks, late_ticks;
  public int has_real_time_priority, has_locked_memory;
}

public static class Glissade {
  public const int Joints = 22;
  const string Library = "glissade_c";

  // Throws an exception with the sentence of the library if a call has failed.
  public static void Check(GlissadeStatus status) {
    if (status != GlissadeStatus.Ok) throw new Exception(Marshal.PtrToStringAnsi(glissade_last_error()));
  }

  [DllImport(Library)] public static extern IntPtr glissade_version();
  [DllImport(Library)] public static extern IntPtr glissade_last_error();
  [DllImport(Library)] public static extern long glissade_now_ns();
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_pose_to_engine(GlissadeEngine engine, ref GlissadePose pose,
      out GlissadePose @out);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_pose_from_engine(GlissadeEngine engine, ref GlissadePose pose,
      out GlissadePose @out);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_vector_to_engine(GlissadeEngine engine, double[] vector,
      [Out] double[] @out);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_vector_from_engine(GlissadeEngine engine, double[] vector,
      [Out] double[] @out);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_torque_to_engine(GlissadeEngine engine, double[] torque,
      [Out] double[] @out);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_torque_from_engine(GlissadeEngine engine, double[] torque,
      [Out] double[] @out);
  [DllImport(Library)] public static extern GlissadeStatus glissade_scene_new(out GlissadeScene scene);
  [DllImport(Library)] public static extern GlissadeStatus glissade_scene_read(string path, out GlissadeScene scene);
  [DllImport(Library)] public static extern GlissadeStatus glissade_scene_free(GlissadeScene scene);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_add_mesh(GlissadeScene scene, string name, double[] vertices,
      ulong vertex_count, int[] triangles, ulong triangle_count, GlissadePose[] X_WB);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_add_file(GlissadeScene scene, string name, string path,
      double scale, GlissadePose[] X_WB);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_add_shape(GlissadeScene scene, string name, string type,
      string[] parameters, double[] values, ulong parameter_count, GlissadePose[] X_WB);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_set_movable(GlissadeScene scene, string name, int is_movable);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_set_pose(GlissadeScene scene, string name, GlissadePose[] X_WB);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_set_margin(GlissadeScene scene, string name, double margin_m);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_add_hand(GlissadeScene scene, int is_left, double length_m,
      double breadth_m);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_set_friction(GlissadeScene scene, double at_rest, double sliding);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_set_stiffness(GlissadeScene scene, double stiffness_N_per_m);
  [DllImport(Library)] public static extern GlissadeStatus glissade_scene_use_real_time_rules(GlissadeScene scene);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_object_count(GlissadeScene scene, out ulong count);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_scene_object(GlissadeScene scene, ulong @object,
      out GlissadeObject @out);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_simulation_new(GlissadeScene scene, out GlissadeSimulation simulation);
  [DllImport(Library)] public static extern GlissadeStatus glissade_simulation_free(GlissadeSimulation simulation);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_simulation_advance(GlissadeSimulation simulation,
      GlissadePose[] ghosts, ulong ghost_count, double milliseconds);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_simulation_part_count(GlissadeSimulation simulation, out ulong count);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_simulation_find_part(GlissadeSimulation simulation, string name,
      out ulong part);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_simulation_part(GlissadeSimulation simulation, ulong part,
      out GlissadePart @out);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_simulation_contacts(GlissadeSimulation simulation, ulong part,
      [Out] GlissadeContact[] contacts, ulong capacity, out ulong count);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_simulation_clearance(GlissadeSimulation simulation, ulong part,
      out double clearance_m);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_simulation_body_name(GlissadeSimulation simulation, int body,
      out IntPtr name);
  [DllImport(Library)] public static extern GlissadeStatus glissade_device_default(out GlissadeDevice device);
  [DllImport(Library)] public static extern GlissadeStatus glissade_glove_state_default(out GlissadeGloveState state);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_glove_new(string name, ref GlissadeDevice device,
      out GlissadeGlove glove);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_glove_new_simulated(double[] times_s, GlissadePose[] X_WH, ulong count,
      out GlissadeGlove glove);
  [DllImport(Library)] public static extern GlissadeStatus glissade_glove_free(GlissadeGlove glove);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_glove_put(GlissadeGlove glove, ref GlissadeGloveState state);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_glove_command(GlissadeGlove glove, out GlissadeGloveCommand command);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_reason_text(int reasons, long age_ns, [Out] byte[] text,
      ulong capacity);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_server_start(GlissadeSimulation simulation, GlissadeGlove[] gloves,
      ulong glove_count, out GlissadeServer server);
  [DllImport(Library)] public static extern GlissadeStatus glissade_server_stop(GlissadeServer server);
  [DllImport(Library)] public static extern GlissadeStatus glissade_server_free(GlissadeServer server);
  [DllImport(Library)] public static extern GlissadeStatus glissade_server_check(GlissadeServer server);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_server_frame(GlissadeServer server, out GlissadeFrame frame);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_server_statistics(GlissadeServer server,
      out GlissadeStatistics statistics);
  [DllImport(Library)]
  public static extern GlissadeStatus glissade_server_grasp(GlissadeServer server, ulong hand, ulong part);
  [DllImport(Library)] public static extern GlissadeStatus glissade_server_release(GlissadeServer server, ulong hand);
  [DllImport(Library)] public static extern GlissadeStatus glissade_server_emergency_stop(GlissadeServer server);
}
