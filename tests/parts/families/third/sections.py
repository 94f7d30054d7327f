"""What free forms of the third series are put together from: closed curves, lofts and bent sections."""
import math

import cadquery as cq
import numpy as np
from OCP.BRepOffsetAPI import BRepOffsetAPI_ThruSections

from ..shapes import W


def closed_curve(radius, plane=None, count=24):
    """A smooth closed wire in a plane (that of x and y): its points, from radius(angle) as (x, y).

    Its knots are equal steps: those of all sections of a loft are the same.
    """
    plane = plane or cq.Plane.XY()
    points = [plane.toWorldCoords((*radius(a), 0)) for a in np.arange(count) * 2 * math.pi / count]
    return cq.Wire.assembleEdges([cq.Edge.makeSpline(points, periodic=True, parameters=range(count + 1))])


def squarish(a, b, power):
    """Radii of a superellipse: half axes a and b, an ellipse for power 2, squarer above."""
    def at(angle):
        c, s = math.cos(angle), math.sin(angle)
        r = (abs(c / a) ** power + abs(s / b) ** power) ** (-1 / power)
        return r * c, r * s
    return at


def lofted(wires):
    """The smooth solid through closed wires, each of one edge and begun at the same angle: one face and two ends."""
    tool = BRepOffsetAPI_ThruSections(True, False)
    tool.CheckCompatibility(False)
    for wire in wires:
        tool.AddWire(wire.wrapped)
    return W(obj=cq.Shape.cast(tool.Shape()))


def tilted(x, z, angle):
    """A plane that faces along z turned by an angle towards x; its own x is that of the world turned along, its y the world's."""
    return cq.Plane((x, 0, z), (math.cos(angle), 0, -math.sin(angle)), (math.sin(angle), 0, math.cos(angle)))


def foil(chord, thick, camber, angle, x, y, z):
    """A closed wire at height z, round at both ends: blunt nose, slimmer tail; thick and camber as shares of the chord."""
    c, s = math.cos(angle), math.sin(angle)
    def at(a):
        u, v = 0.5 * math.cos(a), 0.5 * thick * math.sin(a) * (1 - 0.35 * math.cos(a)) + camber * math.sin(a) ** 2
        return x + chord * (c * u - s * v), y + chord * (s * u + c * v)
    return closed_curve(at, cq.Plane((0, 0, z)), 18)
