"""Connectors and a chip: thin sheets and many small contacts."""
import math

import numpy as np

from .register import part
from .shapes import W, disc, joined, less


@part(uniform=False)
def gullwing_ic():
    low = W("XY", origin=(0, 0, 0.85)).rect(4.9, 3.9).extrude(-0.7, taper=7)
    high = W("XY", origin=(0, 0, 0.85)).rect(4.9, 3.9).extrude(0.7, taper=7)
    body = low.union(high).cut(W().sphere(0.5).translate((-1.9, -1.2, 1.95)))
    r, t, k = 0.15, 0.2, math.sqrt(0.5)
    lead = (W("YZ").moveTo(1.7, 0.95).lineTo(2.2, 0.95).threePointArc((2.2 + (r + t) * k, 0.95 - (r + t) * (1 - k)), (2.2 + r + t, 0.95 - r - t))
            .lineTo(2.55, 0.35).threePointArc((2.55 + r - r * k, 0.35 - r * k), (2.55 + r, 0.2)).lineTo(3.1, 0.2).lineTo(3.1, 0)
            .lineTo(2.7, 0).threePointArc((2.7 - (r + t) * k, (r + t) * (1 - k)), (2.35, r + t)).lineTo(2.35, 0.6)
            .threePointArc((2.2 + r * k, 0.6 + r * k), (2.2, 0.75)).lineTo(1.7, 0.75).close().extrude(0.2, both=True))
    leads = [lead.translate((x, 0, 0)) for x in (-1.905, -0.635, 0.635, 1.905)]
    return joined(body, leads + [q.rotate((0, 0, 0), (0, 0, 1), 180) for q in leads])


@part(turn=True)
def dsub_shell():
    outline = lambda w, h: W().polyline([(-w, h), (w, h), (w - 2, -h), (-w + 2, -h)]).close()
    body = W().box(39, 12.5, 1, centered=(True, True, False)).edges("|Z").fillet(1.5)
    body = body.union(outline(12, 4.2).extrude(7).edges("|Z").fillet(2.2).faces(">Z").edges().fillet(0.6))
    body = body.cut(outline(11.4, 3.6).extrude(6.6).edges("|Z").fillet(1.6).translate((0, 0, 1.2)))
    body = less(body, [disc(1.6, 5, -1, x) for x in (-16.5, 16.5)])
    pins = [(x, 1.4) for x in np.linspace(-5.5, 5.5, 5)] + [(x, -1.4) for x in np.linspace(-4.1, 4.1, 4)]
    pin = lambda x, y: disc(0.5, 8, -3, x, y).faces(">Z or <Z").edges().fillet(0.3)
    return joined(body, [pin(*q) for q in pins])


@part()
def usb_shell():
    outer = W("YZ").sketch().rect(12, 4.5).vertices().fillet(0.6).finalize().extrude(14)
    inner = W("YZ").sketch().rect(11.4, 3.9).vertices().fillet(0.3).finalize().extrude(13).translate((1.2, 0, 0))
    body = outer.cut(inner).union(W().box(10, 10.6, 1.6).translate((5.8, 0, 0.9)).edges(">X").chamfer(0.3))
    body = less(body, [W().box(2.2, 2, 9).translate((8, y, 0)) for y in (-2.8, 2.8)])
    contacts = [W().box(8, 1, 0.3).translate((6, y, 0.05)).edges("|Y and >X").fillet(0.12) for y in (-3.5, -1.1, 1.1, 3.5)]
    return joined(body, contacts)
