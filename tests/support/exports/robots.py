"""Spheres of robots, as their programs read them."""

import json
import re
import xml.etree.ElementTree as ElementTree

from exports.artifact import floats, require, same


def check_sph(data, artifact):
    lines = data.decode("ascii").splitlines()
    same(lines[0], str(len(artifact.points)), "number")
    same([floats(line) for line in lines[1:]], artifact.balls(), "balls")


def check_yaml(data, artifact):
    text = data.decode("ascii")
    if not artifact.points:
        return same(text, "collision_spheres:\n  link: []\n", "text")
    entry = r"    - center: \[(\S+), (\S+), (\S+)\]\n      radius: (\S+)\n"
    require(re.fullmatch(r"collision_spheres:\n  link:\n(" + entry + ")*", text), "the layout")
    same([tuple(map(float, found)) for found in re.findall(entry, text)], artifact.balls(), "spheres")


def ignored_pairs(lists):
    return {(a, b) for a, partners in lists.items() for b in partners}


def yaml_spheres(lists):
    return {link: [(*map(float, s["center"]), float(s["radius"])) for s in spheres] for link, spheres in lists.items()}


def check_curobo(data, artifact):
    import yaml
    kinematics = yaml.safe_load(data)["robot_cfg"]["kinematics"]
    same(yaml_spheres(kinematics["collision_spheres"]), artifact.with_spheres, "spheres")
    same(kinematics["collision_link_names"], list(artifact.with_spheres), "links")
    same(ignored_pairs(kinematics["self_collision_ignore"]), set(artifact.pairs), "pairs")
    require(kinematics["base_link"] in artifact.link_names, "base_link")


def check_xrdf(data, artifact):
    import yaml
    robot = yaml.safe_load(data)
    same((robot["format"], robot["format_version"]), ("xrdf", 1.0), "format")
    geometry = robot["geometry"][robot["collision"]["geometry"]]
    same(yaml_spheres(geometry["spheres"]), artifact.with_spheres, "spheres")
    same(robot["self_collision"]["geometry"], robot["collision"]["geometry"], "geometry")
    same(ignored_pairs(robot["self_collision"]["ignore"]), set(artifact.pairs), "pairs")
    require(set(robot["default_joint_positions"]) <= set(artifact.joint_names), "joints")


def check_foam(data, artifact):
    found = {link: [(*s["origin"], s["radius"]) for s in entry["spheres"]] for link, entry in json.loads(data).items()}
    same(found, artifact.with_spheres, "spheres")


def check_srdf(data, artifact):
    root = ElementTree.fromstring(data)
    found = {link.get("link"): [(*floats(s.get("center")), float(s.get("radius"))) for s in link]
             for link in root.findall("link_sphere_approximation")}
    disabled = {name: spheres or [(0, 0, 0, 0)] for name, spheres in artifact.spheres.items()}
    same(found, disabled, "spheres")
    pairs = [(p.get("link1"), p.get("link2")) for p in root.findall("disable_collisions")]
    same(pairs, artifact.pairs, "pairs")
    reasons = [("Adjacent", "Default", "Always", "Never")[code] for code in artifact.reasons]
    same([p.get("reason") for p in root.findall("disable_collisions")], reasons, "reasons")


def check_mjcf(data, artifact):
    root = ElementTree.fromstring(data)
    bodies = {body.get("name"): body for body in root.iter("body")}
    same(set(bodies), set(artifact.link_names), "bodies")
    for name, body in bodies.items():
        geoms = body.findall("geom")
        require(all(g.get("type") == "sphere" for g in geoms), "spheres only")
        found = [(*floats(g.get("pos")), float(g.get("size"))) for g in geoms]
        same(found, artifact.spheres[name], "spheres of " + name)
        # The place of the body in that of its parent is the origin of its joint.
        for child in body.findall("body"):
            joint = artifact.arrays["joint_children"].index(artifact.link_names.index(child.get("name")))
            same(artifact.link_names[artifact.arrays["joint_parents"][joint]], name, "parent")
            origin = artifact.arrays["joint_origins"][joint]
            same(floats(child.get("pos")), tuple(origin[9:]), "place")
            w, x, y, z = floats(child.get("quat"))
            turned = (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                      2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                      2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y))
            require(all(abs(p - q) < 1e-12 for p, q in zip(turned, origin)), "rotation")
    same([(e.get("body1"), e.get("body2")) for e in root.iter("exclude")], artifact.pairs, "pairs")


def check_urdf(data, artifact):
    if artifact.type == "RobotSpheres":
        root = ElementTree.fromstring(data)
        found = {link.get("name"): [(*floats(c.find("origin").get("xyz")), float(c.find("geometry/sphere").get("radius")))
                                    for c in link.findall("collision")] for link in root.findall("link")}
        same({j.get("name") for j in root.findall("joint")}, set(artifact.joint_names), "joints")
        return same(found, artifact.spheres, "spheres")
    link = ElementTree.fromstring(data).find("link")
    found = [(*floats(c.find("origin").get("xyz")), float(c.find("geometry/sphere").get("radius"))) for c in link]
    same(found, artifact.balls(), "spheres")
