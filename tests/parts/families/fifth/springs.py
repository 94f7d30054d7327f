"""Springs."""
import math

import cadquery as cq

from ..register import part
from ..second.outlines import lying
from ..shapes import W, disc, joined, less, radial
from ..third.skins import under
from .profiles import sector


@part(turn=True, offset=1.0)
def torsion_spring():
    r, wire, pitch, turns = 9, 1.5, 3.6, 2.25
    climb = pitch / (2 * math.pi)
    coil = cq.Wire.makeHelix(pitch, pitch * turns, r)
    across = lambda x, y, z, out, along: W(cq.Plane((x, y, z), out, along)).circle(wire)
    body = across(r, 0, 0, (1, 0, 0), (0, r, climb)).sweep(W(obj=coil), isFrenet=True)
    legs = [across(r, 0, 0, (1, 0, 0), (0, -r, -climb)).extrude(34), across(0, r, pitch * turns, (0, 1, 0), (-r, 0, climb)).extrude(26)]
    return joined(body, legs)


@part(turn=True)
def wave_washer():
    height = lambda x, y: 4e-4 * (x ** 3 - 3 * x * y * y)
    blank = W("XY", origin=(0, 0, -20)).circle(15).extrude(50)
    body = under(lambda x, y: height(x, y) + 0.9, blank, 18, 18).cut(under(height, blank, 18, 18))
    return body.cut(disc(10.5, 60, -30)).cut(W("XY", origin=(15, 0, -20)).circle(1.6).extrude(40))


@part(turn=True, offset=1.0, scale=3)
def leaf_spring():
    down = lambda body: body.rotate((0, 0, 0), (0, 1, 0), -90).rotate((0, 0, 0), (0, 0, 1), 90)
    leaf = lambda k, half: sector(160 + 4 * k, 164 + 4 * k, half, 24 - 0.8 * k, -12 + 0.4 * k)
    body = joined(leaf(0, 0.42), [leaf(k, half) for k, half in ((1, 0.33), (2, 0.24), (3, 0.15))])
    body = joined(body, [disc(8, 24, -12, *radial(165, a)) for a in (-0.42, 0.42)])
    body = less(body, [disc(5, 60, -30, *radial(165, a)) for a in (-0.42, 0.42)])
    clip = W().box(16, 20, 30).translate((167, 0, 0)).edges("|Y").fillet(2)
    body = body.union(clip).union(lying(disc(5, 8), "+x").translate((172, 0, 0)))
    return down(body)
