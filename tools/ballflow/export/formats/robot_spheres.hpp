// Writers of the balls of a robot. Lengths are metres, frames are those of the links; text holds the shortest
// decimals that give the doubles back.
#pragma once

#include "ballflow/output_file.hpp"
#include "types/robot_spheres.hpp"

namespace ballflow {

/// The description that the robot was read from, its collisions replaced by the balls.
void write_spheres_urdf(const geometry::RobotSpheres& spheres, OutputFile& out);

/// MoveIt: <link_sphere_approximation> for every link, with one sphere of radius 0 for links without balls,
/// which has them left out, and <disable_collisions> for the pairs.
void write_spheres_srdf(const geometry::RobotSpheres& spheres, OutputFile& out);

/// cuRobo: the parts of robot_cfg.kinematics that follow from the balls: collision_link_names,
/// collision_spheres, self_collision_ignore, self_collision_buffer.
void write_curobo(const geometry::RobotSpheres& spheres, OutputFile& out);

/// XRDF 1.0: geometry, collision, self_collision and default_joint_positions.
void write_xrdf(const geometry::RobotSpheres& spheres, OutputFile& out);

/// JSON: a list of {origin, radius} as foam has it, for each link.
void write_foam(const geometry::RobotSpheres& spheres, OutputFile& out);

/// MuJoCo: bodies with joints and spheres, <exclude> for the pairs. Planar joints are fixed, floating ones
/// too where they are not at the root.
void write_mjcf(const geometry::RobotSpheres& spheres, OutputFile& out);

/// link,x,y,z,radius
void write_spheres_csv(const geometry::RobotSpheres& spheres, OutputFile& out);

}  // namespace ballflow
