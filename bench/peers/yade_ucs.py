"""Uniaxial test of an exported specimen in Yade (JCFpm with smooth joints), run by run.py:

    yade -n -x -j1 yade_ucs.py FOLDER

FOLDER holds discs.csv, contacts of one specimen (phyllite specimen --out) and peer.json with the settings of the test. Same discs,
masses per metre of thickness, stiffnesses, strengths, joints, damping, platens and stop rule as in Phyllite; the time
step is Phyllite's. What differs is JCFpm itself: one spring per contact instead of linear contact and bond side by side,
no moment in bonds, shear strength with friction (cohesion + F_n tan phi) from the start.
"""
import csv
import glob
import json
import math
import os
import sys
import time

from yade import *  # noqa: F403

folder = sys.argv[1]
settings = json.load(open(folder + "/peer.json"))


def table(name):
    with open(folder + "/" + name) as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


grain = JCFpmMat(type=1, young=1e9, poisson=0.3, density=settings["density"], frictionAngle=math.atan(settings["mu"]),
                 tensileStrength=1.0, cohesion=1.0)
platen = JCFpmMat(type=0, young=1e9, poisson=0.3, density=settings["density"], frictionAngle=0.0)
O.materials.append(grain)
O.materials.append(platen)

for disc in table("discs.csv"):
    x, y, r = (float(disc[key + " [m]"]) for key in ("x", "y", "r"))
    body = sphere((x, y, 0), r, material=grain)
    body.state.mass = settings["density"] * math.pi * r * r
    body.state.inertia = Vector3(1, 1, 1) * 0.5 * body.state.mass * r * r
    body.state.blockedDOFs = "zXY"
    O.bodies.append(body)
bottom = O.bodies.append(wall(0.0, 1, 1, material=platen))
top = O.bodies.append(wall(settings["height"], 1, -1, material=platen))

law = Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM(smoothJoint=True)
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb(), Bo1_Wall_Aabb()], verletDist=0.1 * settings["r_min"]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom(), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=1)], [law]),
    NewtonIntegrator(damping=settings["damping"]),
]
O.dt = 1e-30
O.step()  # finds the contacts, moves nothing

contacts = glob.glob(folder + "/contacts*.csv")[0]
known = {(int(c["grain_a"]), int(c["grain_b"])): c for c in table(os.path.basename(contacts))}
n_contacts = 0
for i in O.interactions:
    pair = tuple(sorted((i.id1, i.id2)))
    c = known.get(pair)
    phys = i.phys
    if c is None:  # grain and platen: two such grains in series halve the stiffness
        phys.kn, phys.ks = settings["wall_kn"], settings["wall_ks"]
        phys.isCohesive, phys.FnMax, phys.FsMax = False, 0, 0
        phys.initD = i.geom.penetrationDepth
        continue
    n_contacts += 1
    area = 2.0 * min(O.bodies[pair[0]].shape.radius, O.bodies[pair[1]].shape.radius)
    phys.kn, phys.ks = float(c["k_n [N/m per m]"]), float(c["k_s [N/m per m]"])
    phys.crossSection = area
    if c["kind"] == "touching":
        phys.isCohesive, phys.FnMax, phys.FsMax = False, 0, 0
        phys.initD = i.geom.penetrationDepth
        continue
    phys.isCohesive = True
    phys.FnMax, phys.FsMax = float(c["sigma_c [Pa]"]) * area, float(c["tau_c [Pa]"]) * area
    if c["kind"] == "joint":
        phys.FnMax, phys.FsMax = settings["joint_tension"] * area, settings["joint_cohesion"] * area
        normal = Vector3(float(c["normal_x"]), float(c["normal_y"]), 0)
        if normal.dot(i.geom.normal) < 0:
            normal = -normal
        phys.isOnJoint, phys.jointNormal = True, normal
        phys.tanFrictionAngle, phys.tanDilationAngle = settings["joint_mu"], 0.0
        phys.initD = abs((O.bodies[i.id1].state.pos - O.bodies[i.id2].state.pos).dot(normal))
    else:
        phys.initD = i.geom.penetrationDepth
        phys.tanFrictionAngle = settings["mu"]

# Ids shared by both hands of the test: platens move towards each other at a constant speed.
O.dt = settings["dt"]
O.bodies[bottom].state.vel = (0, settings["speed"], 0)
O.bodies[top].state.vel = (0, -settings["speed"], 0)
peak, peak_strain, strain, seconds, steps = 0.0, 0.0, 0.0, 0.0, 0
limit = settings["max_steps"]
while steps < limit:
    start = time.process_time()
    O.run(100, True)
    seconds += time.process_time() - start
    steps += 100
    strain = 2.0 * settings["speed"] * steps * O.dt / settings["height"]
    stress = 0.5 * (O.forces.f(top)[1] - O.forces.f(bottom)[1]) / settings["width"]
    if stress > peak:
        peak, peak_strain = stress, strain
    if strain > 5e-4 and (stress < settings["stop_at"] * peak or strain > 1.3 * peak_strain):
        break
print("RESULT " + json.dumps({"steps": steps, "seconds": seconds, "contacts": n_contacts, "ucs": peak,
                              "peak_strain": peak_strain, "strain": strain, "ended": steps < limit}))
