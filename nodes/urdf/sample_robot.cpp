#include "urdf/sample_robot.hpp"

#include "base/monitor.hpp"

namespace ballflow::geometry {
namespace {

constexpr const char* arm = R"(<?xml version="1.0"?>
<robot name="arm">
  <link name="base">
    <collision><origin xyz="0 0 0.04"/><geometry><box size="0.24 0.2 0.08"/></geometry></collision>
    <collision><origin xyz="0 0 0.11"/><geometry><cylinder radius="0.07" length="0.06"/></geometry></collision>
  </link>
  <link name="upper_arm">
    <collision><origin xyz="0 0 0.16"/><geometry><cylinder radius="0.05" length="0.32"/></geometry></collision>
    <collision><origin xyz="0 0 0.34"/><geometry><sphere radius="0.065"/></geometry></collision>
  </link>
  <link name="forearm">
    <collision><origin xyz="0.13 0 0"/><geometry><box size="0.26 0.07 0.05"/></geometry></collision>
  </link>
  <link name="hand">
    <collision><origin xyz="0.03 0 0"/><geometry><box size="0.06 0.12 0.06"/></geometry></collision>
  </link>
  <link name="left_finger">
    <collision><origin xyz="0.025 0.006 0"/><geometry><box size="0.05 0.012 0.02"/></geometry></collision>
  </link>
  <link name="right_finger">
    <collision><origin xyz="0.025 -0.006 0"/><geometry><box size="0.05 0.012 0.02"/></geometry></collision>
  </link>
  <link name="tool"/>
  <joint name="turn" type="revolute">
    <parent link="base"/><child link="upper_arm"/><origin xyz="0 0 0.14"/><axis xyz="0 0 1"/>
    <limit lower="-2.9" upper="2.9" effort="10" velocity="1"/>
  </joint>
  <joint name="elbow" type="revolute">
    <parent link="upper_arm"/><child link="forearm"/><origin xyz="0 0.07 0.34"/><axis xyz="0 1 0"/>
    <limit lower="-2.2" upper="2.2" effort="10" velocity="1"/>
  </joint>
  <joint name="wrist" type="continuous">
    <parent link="forearm"/><child link="hand"/><origin xyz="0.27 0 0"/><axis xyz="1 0 0"/>
  </joint>
  <joint name="left" type="prismatic">
    <parent link="hand"/><child link="left_finger"/><origin xyz="0.06 0 0"/><axis xyz="0 1 0"/>
    <limit lower="0" upper="0.04" effort="1" velocity="1"/>
  </joint>
  <joint name="right" type="prismatic">
    <parent link="hand"/><child link="right_finger"/><origin xyz="0.06 0 0"/><axis xyz="0 -1 0"/>
    <limit lower="0" upper="0.04" effort="1" velocity="1"/><mimic joint="left"/>
  </joint>
  <joint name="mount" type="fixed">
    <parent link="hand"/><child link="tool"/><origin xyz="0.11 0 0"/>
  </joint>
</robot>
)";

constexpr const char* spheres = R"(link,x,y,z,radius
base,0,0,0.06,0.13
upper_arm,0,0,0.08,0.1
upper_arm,0,0,0.24,0.1
upper_arm,0,0,0.34,0.07
forearm,0.07,0,0,0.08
forearm,0.19,0,0,0.08
hand,0.03,0,0,0.07
left_finger,0.025,0.006,0,0.028
right_finger,0.025,-0.006,0,0.028
)";

}  // namespace

std::string sample_spheres(const std::string& name) {
  if (name == "spheres:arm") return spheres;
  throw InputError("there are no spheres \"" + name + "\"",
                   "spheres:arm are those there are; or give a file of spheres");
}

std::string sample_robot(const std::string& name) {
  if (name == "robot:arm") return arm;
  throw InputError("there is no robot \"" + name + "\"",
                   "robot:arm is the one there is; or give the file of a URDF");
}

}  // namespace ballflow::geometry
