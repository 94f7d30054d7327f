"""The five analytic surfaces, and which of them a B-rep face lies on.

Geometry decides: a face that the kernel stores as a spline, a revolution or an extrusion is fitted with each of the
five and counts as one of them where every sample lies within RECOGNISE of it.
"""
import math

import numpy as np
from OCP.BRep import BRep_Tool
from OCP.BRepAdaptor import BRepAdaptor_Surface
from OCP.BRepGProp import BRepGProp_Face
from OCP.GeomAbs import GeomAbs_SurfaceType as Kind
from OCP.gp import gp_Pnt, gp_Vec
from OCP.ShapeAnalysis import ShapeAnalysis_Surface
from OCP.TopLoc import TopLoc_Location

from unusable import Unusable

ANALYTIC = ("plane", "cylinder", "cone", "sphere", "torus")
RECOGNISE = 1e-5  # a face is analytic if its samples are this close to the surface (share of diagonal)
SAME = 1e-6       # two faces are on one surface if each is this close to the other's
DOUBTFUL = 1e-3   # free-form faces this close to an analytic surface are named in `problems`


def unit(v):
    return np.asarray(v, float) / np.linalg.norm(v)


class Surface:
    """One of the five analytic surfaces: distance of points from it, and its normals."""

    def __init__(self, kind, axis=(0, 0, 1), point=(0, 0, 0), r=0.0, minor=0.0):
        # point: on the plane or axis, the cone's apex, a centre; r: radius, half angle, major radius
        self.kind, self.axis, self.point, self.r, self.minor = kind, unit(axis), np.asarray(point, float), r, minor

    def residual(self, p):
        """Signed distances and unit normals (away from the axis, centre or tube centre)."""
        d = p - self.point
        if self.kind == "plane":
            return d @ self.axis, np.broadcast_to(self.axis, p.shape)
        if self.kind == "sphere":
            length = np.linalg.norm(d, axis=1)
            return length - self.r, d / np.maximum(length, 1e-300)[:, None]
        h = d @ self.axis
        out = d - h[:, None] * self.axis
        rho = np.linalg.norm(out, axis=1)
        out = out / np.maximum(rho, 1e-300)[:, None]
        if self.kind == "cylinder":
            return rho - self.r, out
        if self.kind == "cone":
            c, s = math.cos(self.r), math.sin(self.r)
            return rho * c - h * s, c * out - s * self.axis
        tube = np.hypot(rho - self.r, h)
        normal = ((rho - self.r)[:, None] * out + h[:, None] * self.axis) / np.maximum(tube, 1e-300)[:, None]
        return tube - self.minor, normal

    def parameters(self, sign):
        """As the JSON has them; a plane's normal points outward."""
        point, axis = self.point.tolist(), self.axis.tolist()
        return {"plane": lambda: {"point": point, "normal": (self.axis * sign).tolist()},
                "cylinder": lambda: {"point": point, "axis": axis, "radius": self.r},
                "cone": lambda: {"apex": point, "axis": axis, "half_angle": self.r},
                "sphere": lambda: {"center": point, "radius": self.r},
                "torus": lambda: {"center": point, "axis": axis, "major_radius": self.r,
                                  "minor_radius": self.minor}}[self.kind]()


def stored_surface(adaptor):
    """The analytic surface the kernel stores for a face, or None."""
    xyz = lambda v: (v.X(), v.Y(), v.Z())
    kind = adaptor.GetType()
    if kind == Kind.GeomAbs_Plane:
        s = adaptor.Plane()
        return Surface("plane", xyz(s.Axis().Direction()), xyz(s.Location()))
    if kind == Kind.GeomAbs_Cylinder:
        s = adaptor.Cylinder()
        return Surface("cylinder", xyz(s.Axis().Direction()), xyz(s.Location()), s.Radius())
    if kind == Kind.GeomAbs_Cone:
        s = adaptor.Cone()
        axis = np.array(xyz(s.Axis().Direction())) * math.copysign(1, s.SemiAngle())
        return Surface("cone", axis, xyz(s.Apex()), abs(s.SemiAngle()))
    if kind == Kind.GeomAbs_Sphere:
        s = adaptor.Sphere()
        return Surface("sphere", point=xyz(s.Location()), r=s.Radius())
    if kind == Kind.GeomAbs_Torus:
        s = adaptor.Torus()
        return Surface("torus", xyz(s.Axis().Direction()), xyz(s.Location()), s.MajorRadius(), s.MinorRadius())
    return None


def fits(p, n):
    """Analytic surfaces that points p with normals n may lie on, each in closed form."""
    middle = p.mean(0)
    yield Surface("plane", np.linalg.svd(p - middle, full_matrices=False)[2][2], middle)
    x, rest = np.linalg.lstsq(np.c_[2 * (p - middle), np.ones(len(p))], ((p - middle) ** 2).sum(1), rcond=None)[:2]
    yield Surface("sphere", point=middle + x[:3], r=math.sqrt(max(x[3] + x[:3] @ x[:3], 1e-300)))
    # Cylinder: the normals are square to the axis.
    axis = np.linalg.svd(n)[2][2]
    frame = np.linalg.svd(axis[None])[2][1:]
    q = (p - middle) @ frame.T
    x = np.linalg.lstsq(np.c_[2 * q, np.ones(len(q))], (q ** 2).sum(1), rcond=None)[0]
    yield Surface("cylinder", axis, middle + x[:2] @ frame, math.sqrt(max(x[2] + x[:2] @ x[:2], 1e-300)))
    # Cone: the normals keep one angle to the axis; every tangent plane holds the apex.
    axis = np.linalg.svd(n - n.mean(0))[2][2]
    apex = middle + np.linalg.lstsq(n, ((p - middle) * n).sum(1), rcond=None)[0]
    axis = axis * math.copysign(1, axis @ (middle - apex))
    half = math.asin(min(1.0, abs(float((n @ axis).mean()))))
    if 1e-3 < half < math.pi / 2 - 1e-3:
        yield Surface("cone", axis, apex, half)
    # Torus: every normal line meets the axis (Pluecker coordinates), the meridian is a circle.
    size = np.abs(p - middle).max()
    lines = np.c_[n, np.cross((p - middle) / size, n)]
    w = np.linalg.svd(lines)[2][5]
    axis, moment = w[3:], w[:3]
    if np.linalg.norm(axis) > 1e-6:
        moment, axis = moment / np.linalg.norm(axis), unit(axis)
        origin = middle + size * np.cross(axis, moment)
        h = (p - origin) @ axis
        rho = np.linalg.norm(p - origin - h[:, None] * axis, axis=1)
        x = np.linalg.lstsq(np.c_[2 * rho, 2 * h, np.ones(len(h))], rho ** 2 + h ** 2, rcond=None)[0]
        if x[0] > 0:
            yield Surface("torus", axis, origin + x[1] * axis, x[0], math.sqrt(max(x[2] + x[:2] @ x[:2], 1e-300)))


class Face:
    """A B-rep face: samples of it, its surface, its type."""

    def __init__(self, face, diagonal):
        self.face, self.gprop, self.diagonal = face, BRepGProp_Face(face), diagonal
        self.on_surface = ShapeAnalysis_Surface(BRep_Tool.Surface_s(face))
        self.points, self.normals = self.samples()
        adaptor = BRepAdaptor_Surface(face)
        self.stored = adaptor.GetType().name.removeprefix("GeomAbs_")
        self.surface, self.recognised, self.near = stored_surface(adaptor), False, None
        if self.surface is None:
            self.recognise()
        if self.surface is not None:
            self.type = self.surface.kind
            self.sign = 1 if (self.surface.residual(self.points)[1] * self.normals).sum(1).mean() > 0 else -1
        else:
            self.type = "bspline" if self.stored in ("BSplineSurface", "BezierSurface") else "other"

    def samples(self, most=300):
        """Points and outward normals at the nodes and centroids of the face's triangulation."""
        mesh = BRep_Tool.Triangulation_s(self.face, TopLoc_Location())
        if mesh is None:
            raise Unusable("a face that cannot be triangulated")
        uv = np.array([(q.X(), q.Y()) for q in (mesh.UVNode(i + 1) for i in range(mesh.NbNodes()))])
        tri = np.array([mesh.Triangle(i + 1).Get() for i in range(mesh.NbTriangles())]) - 1
        uv = np.concatenate([uv, uv[tri].mean(1)])
        uv = uv[np.random.default_rng(1).permutation(len(uv))[:most]]
        p, n = map(np.array, zip(*(self.at(*q) for q in uv)))
        good = np.isfinite(n).all(1)
        return p[good], n[good]

    def at(self, u, v):
        """Point and outward unit normal (nan where there is none) at parameters u, v."""
        p, n = gp_Pnt(), gp_Vec()
        self.gprop.Normal(u, v, p, n)
        length = n.Magnitude()
        return (p.X(), p.Y(), p.Z()), ((n.X() / length, n.Y() / length, n.Z() / length) if length > 1e-12 else (np.nan,) * 3)

    def normal_near(self, p):
        uv = self.on_surface.ValueOfUV(gp_Pnt(*map(float, p)), 1e-9)
        return self.at(uv.X(), uv.Y())[1]

    def distance(self, p):
        self.on_surface.ValueOfUV(gp_Pnt(*map(float, p)), 1e-9)
        return self.on_surface.Gap()

    def misfit(self, surface):
        """Greatest distance of the samples from a surface (share of diagonal); inf if they face elsewhere."""
        distance, normal = surface.residual(self.points)
        if np.quantile(np.abs((normal * self.normals).sum(1)), 0.02) < 0.999:
            return math.inf
        return float(np.abs(distance).max() / self.diagonal)

    def recognise(self):
        """The simplest surface that fits; failing that, notes the best one if it nearly does."""
        found = [(self.misfit(s), s) for s in fits(self.points, self.normals) if max(s.r, s.minor) < 100 * self.diagonal]
        self.surface = next((s for misfit, s in found if misfit < RECOGNISE), None)
        self.recognised = self.surface is not None
        misfit, best = min(found, key=lambda item: item[0])
        if not self.recognised and misfit < DOUBTFUL:
            self.near = (best.kind, misfit)

    def same_surface(self, other, tolerance=None):
        if self.surface is None or other.surface is None or self.type != other.type:
            return False
        tolerance = tolerance or (RECOGNISE if self.recognised or other.recognised else SAME)
        mine, theirs = (face.sign * face.surface.residual(other.points)[1] for face in (self, other))
        return (mine * theirs).sum(1).mean() > 0 and max(self.misfit(other.surface), other.misfit(self.surface)) < tolerance
