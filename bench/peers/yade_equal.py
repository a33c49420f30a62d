"""Uniaxial test of an exported specimen in Yade with the contact laws of Phyllite, run by equal.py:

    yade -n -x -j1 yade_equal.py FOLDER

FOLDER holds discs.csv, contacts of one specimen (phyllite specimen --out) and peer.json with the settings of the test. Yade has no law that holds
a linear contact and a parallel bond side by side, but it has both. So a disc is a clump of two spheres of one centre that see only their own kind:
  grain   JCFpm without cohesion: normal spring from a reference overlap, shear spring, Coulomb's law (neverErase: what opens may close again)
  cement  CohFrict with moments: springs in both directions, bending stiffness, tensile and shear strength, no friction, no moment in its strength
and a joint of the bedding is JCFpm's smooth joint. Every number of every contact is the exported one. Python takes away a bond that has broken in
shear, which CohFrict would leave as a spring. Masses, step, damping, platens and stop rule are Phyllite's.

Two things of a joint are added in Python, for Yade's joint knows neither: it feels how its grains turn (their slide and closure at the contact, and the
torque of its force on them), and grains of two layers that meet during the test press through a joint without a bond.

"variant" in peer.json changes one thing at a time. Without bedding: "no_bending" (bonds without bending stiffness), "friction" (bonds whose shear
strength grows with friction), "one_spring" (JCFpm as it comes: one spring per contact, its friction from the start, no moments). With
bedding: "no_turning" and "no_new_joints", Yade's joint without the one or the other.
"""
import csv
import glob
import json
import math
import sys

from yade import *  # noqa: F403

folder = sys.argv[1]
settings = json.load(open(folder + "/peer.json"))
variant = settings["variant"]
SOFT = 1e-6  # [Pa]: of what must carry nothing
CARE = 4  # steps after which broken bonds are looked for


def table(name):
    with open(name) as lines:
        return list(csv.DictReader(line for line in lines if not line.startswith("#")))


def placed(disc):
    """Grain and cement of a disc, and the clump of both, which moves with the disc's own mass."""
    x, y, r = (float(disc[key + " [m]"]) for key in ("x", "y", "r"))
    # young r = E_c: two grains in contact get k_n = E_c whatever their radii, a grain and a hard wall 2 E_c.
    grain = JCFpmMat(type=1, young=settings["E_c"] / r, poisson=settings["ratio"], density=1, frictionAngle=math.atan(settings["mu"]))
    cement = CohFrictMat(young=SOFT, poisson=0.3, density=1, frictionAngle=0, isCohesive=True, momentRotationLaw=True)
    parts = [sphere((x, y, 0), r, material=grain), sphere((x, y, 0), r, material=cement)]
    parts[0].mask, parts[1].mask = 1, 2
    number, (of_grain, of_cement) = O.bodies.appendClumped(parts)
    state = O.bodies[number].state
    state.mass = settings["density"] * math.pi * r * r
    state.inertia = Vector3(1, 1, 1) * 0.5 * state.mass * r * r
    state.blockedDOFs = "zXY"
    return number, of_grain, of_cement, r


discs = [placed(d) for d in table(folder + "/discs.csv")]
hard = JCFpmMat(type=0, young=1e9 * settings["E_c"] / discs[0][3], poisson=settings["ratio"], density=1, frictionAngle=0)
walls = [O.bodies.append(wall(at, 1, sense, material=hard)) for at, sense in ((0.0, 1), (settings["height"], -1))]
for w in walls:
    O.bodies[w].mask = 1

factor = 1.0 + 1e-5  # so that pairs bonded across the smallest gaps are found
O.engines = [
    ForceResetter(),
    PyRunner(iterPeriod=1, command="slide_by_turning()", label="turn_before", dead=True),
    InsertionSortCollider([Bo1_Sphere_Aabb(aabbEnlargeFactor=factor), Bo1_Wall_Aabb()], verletDist=0.05 * settings["r_min"]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom6D(interactionDetectionFactor=factor, avoidGranularRatcheting=False), Ig2_Wall_Sphere_ScGeom()],
                    [Ip2_JCFpmMat_JCFpmMat_JCFpmPhys(cohesiveTresholdIteration=0), Ip2_CohFrictMat_CohFrictMat_CohFrictPhys()],
                    [Law2_ScGeom_JCFpmPhys_JointedCohesiveFrictionalPM(smoothJoint=True, neverErase=True),
                     Law2_ScGeom6D_CohFrictPhys_CohesionMoment()]),
    PyRunner(iterPeriod=1, command="torques_of_joints()", label="turn_after", dead=True),
    PyRunner(iterPeriod=4 * CARE, command="lay_new_joints()", label="lay", dead=True),
    PyRunner(iterPeriod=CARE, command="take_away()", label="care", dead=True),
    NewtonIntegrator(damping=settings["damping"], exactAsphericalRot=False),
]
O.dt = 1e-30
O.step()  # finds the contacts, moves nothing



class Joint:
    """What Python adds to a joint: levers of its grains, cosine and sine between branch and normal, of the step before."""

    def __init__(self, interaction):
        self.interaction, self.phys = interaction, interaction.phys
        self.one, self.two = O.bodies[interaction.id1].state, O.bodies[interaction.id2].state
        self.tangent = Vector3(-self.phys.jointNormal[1], self.phys.jointNormal[0], 0)
        self.look()

    def look(self):
        branch = self.two.pos - self.one.pos
        length = branch.norm()
        self.branch = branch / length
        g = self.interaction.geom
        self.lever_1, self.lever_2 = g.refR1 - 0.5 * g.penetrationDepth, g.refR2 - 0.5 * g.penetrationDepth
        n = self.phys.jointNormal
        self.along, self.off = self.branch.dot(n), self.branch[0] * n[1] - self.branch[1] * n[0]


contacts = table(glob.glob(folder + "/contacts*.csv")[0])
bonds, joints = [], []
for c in contacts:
    a, b = discs[int(c["grain_a"])], discs[int(c["grain_b"])]
    width = 2.0 * min(a[3], b[3])
    k_n, k_s = float(c["k_n [N/m per m]"]), float(c["k_s [N/m per m]"])
    grain = O.interactions[a[1], b[1]]
    if c["kind"] == "joint":
        p, normal = grain.phys, Vector3(float(c["normal_x"]), float(c["normal_y"]), 0)
        p.jointNormal = normal if normal.dot(grain.geom.normal) > 0 else -normal
        p.kn, p.ks, p.isOnJoint, p.isCohesive = k_n, k_s, True, True
        p.FnMax, p.FsMax = settings["joint_tension"] * width, settings["joint_cohesion"] * width
        p.tanFrictionAngle, p.tanDilationAngle = settings["joint_mu"], 0.0
        p.initD = abs((O.bodies[grain.id1].state.pos - O.bodies[grain.id2].state.pos).dot(p.jointNormal))
        joints.append(Joint(grain))
    if c["kind"] != "bonded":
        continue
    tension, shear = float(c["sigma_c [Pa]"]) * width, float(c["tau_c [Pa]"]) * width
    if variant == "one_spring":
        p = grain.phys
        p.kn, p.ks, p.isCohesive, p.FnMax, p.FsMax = k_n, k_s, True, tension, shear
        bonds.append((grain, p))
        continue
    cement = O.interactions[a[2], b[2]]
    p = cement.phys
    p.kn, p.ks = k_n - settings["E_c"], k_s - settings["ratio"] * settings["E_c"]
    p.kr = 0.0 if variant == "no_bending" else float(c["k_m [N]"])
    p.ktw, p.maxRollPl, p.maxTwistPl = 0.0, -1.0, -1.0
    p.normalAdhesion, p.shearAdhesion = tension, shear
    p.cohesionBroken, p.fragile, p.cohesionDisablesFriction = False, True, variant != "friction"
    p.tangensOfFrictionAngle = settings["mu"] if variant == "friction" else 0.0
    p.unp = cement.geom.penetrationDepth
    bonds.append((cement, p))
print(f"{len(contacts)} contacts: {len(bonds)} bonds, {len(joints)} joints")

def broken(interaction, p):
    """Yade erases what breaks in tension; the two spheres then meet anew, without cement."""
    if variant == "one_spring":
        return not p.isCohesive
    return p.cohesionBroken or not interaction.isReal or interaction.phys.kn < 1.0


whole, whole_joints, cracks = bonds, [j.phys for j in joints], 0


def slide_by_turning():
    """Slide along the plane and closure across it."""
    for j in joints:
        turned = (j.one.angVel[2] * j.lever_1 + j.two.angVel[2] * j.lever_2) * O.dt
        j.phys.shearForce += j.phys.ks * turned * j.along * j.tangent
        j.phys.initD += turned * j.off


def torques_of_joints():
    for j in joints:
        j.look()
        f = j.phys.normalForce + j.phys.shearForce
        across = Vector3(0, 0, j.branch[0] * f[1] - j.branch[1] * f[0])
        O.forces.addT(j.interaction.id1, -j.lever_1 * across)
        O.forces.addT(j.interaction.id2, -j.lever_2 * across)


def layer_of(number):
    """The layer that a grain's centre lay in at the start."""
    t = math.radians(settings["theta"])
    at = O.bodies[number].state.refPos - Vector3(0.5 * settings["width"], 0.5 * settings["height"], 0)
    return math.floor((at[1] * math.cos(t) - at[0] * math.sin(t) - settings["offset"]) / settings["spacing"])


layers = {d[1]: layer_of(d[1]) for d in discs} if joints else {}
seen = {(i.id1, i.id2) for i in O.interactions}


def lay_new_joints():
    """Pairs of two layers that have met since the last time."""
    t = math.radians(settings["theta"])
    for i in O.interactions:
        pair = (i.id1, i.id2)
        if pair in seen:
            continue
        seen.add(pair)
        if layers.get(i.id1) == layers.get(i.id2) or i.id1 not in layers or i.id2 not in layers:
            continue
        p, normal = i.phys, Vector3(-math.sin(t), math.cos(t), 0)
        width = 2.0 * min(i.geom.refR1, i.geom.refR2)
        p.jointNormal = normal if normal.dot(i.geom.normal) > 0 else -normal
        p.kn, p.ks, p.isOnJoint = settings["joint_kn"] * width, settings["joint_ks"] * width, True
        p.tanFrictionAngle, p.shearForce = settings["joint_mu"], Vector3(0, 0, 0)
        p.initD = abs((O.bodies[i.id1].state.pos - O.bodies[i.id2].state.pos).dot(p.jointNormal))
        joints.append(Joint(i))


def take_away():
    """Takes broken bonds away and counts them."""
    global whole, whole_joints, cracks
    gone = [bond for bond in whole if broken(*bond)]
    if gone:
        for _, p in gone:
            if variant != "one_spring":
                p.kn = p.ks = p.kr = 0.0
        whole = [bond for bond in whole if not broken(*bond)]
        cracks += len(gone)
    if any(not p.isCohesive for p in whole_joints):
        left = [p for p in whole_joints if p.isCohesive]
        cracks, whole_joints = cracks + len(whole_joints) - len(left), left


O.dt = settings["dt"]
care.dead = False  # noqa: F405
turn_before.dead = turn_after.dead = not joints or variant == "no_turning"  # noqa: F405
lay.dead = not joints or variant == "no_new_joints"  # noqa: F405
strain, peak, peak_strain, time, share, rows = 0.0, 0.0, 0.0, 0.0, 0.0, []
rate = 2.0 * settings["speed"] / settings["height"]
ramp = 2.0 * settings["ramp_strain"] / rate  # the speed rises linearly over this time
BLOCK = 100
while strain < settings["max_strain"]:
    for _ in range(BLOCK):
        if time <= ramp + O.dt:
            share = min(1.0, (time + 0.5 * O.dt) / ramp)
            for w, sense in zip(walls, (1, -1)):
                O.bodies[w].state.vel = (0, sense * share * settings["speed"], 0)
        O.step()
        time += O.dt
        strain += share * rate * O.dt
    stress = 0.5 * (O.forces.f(walls[1])[1] - O.forces.f(walls[0])[1]) / settings["width"]
    rows.append((O.iter - 1, strain, stress, cracks))
    if stress > peak:
        peak, peak_strain = stress, strain
    if cracks > 2 and (stress < settings["stop_at"] * peak or strain > (1.0 + settings["post_peak"]) * peak_strain):
        break
with open(folder + f"/yade-{variant}.csv", "w") as out:
    out.write("step [1],axial_strain [1],axial_stress [Pa],n_cracks [1]\n")
    out.writelines(",".join(repr(v) for v in row) + "\n" for row in rows)
