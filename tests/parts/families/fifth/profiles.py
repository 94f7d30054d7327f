"""What the fifth series is put together from besides: outlines with rounded corners, sectors of a ring."""
import math

import numpy as np

from ..shapes import W, radial


def outline(*corners, plane="XY", origin=(0, 0, 0)):
    """A closed outline of straight lines through corners (x, y), rounded where a corner is (x, y, radius)."""
    points = [np.array(corner[:2], float) for corner in corners]
    path = []
    for k, (corner, here) in enumerate(zip(corners, points)):
        if len(corner) == 2:
            path.append((here,))
            continue
        to_last, to_next = (side / np.linalg.norm(side) for side in (points[k - 1] - here, points[(k + 1) % len(points)] - here))
        half, middle = math.acos(float(to_last @ to_next)) / 2, to_last + to_next
        reach, centre = corner[2] / math.tan(half), here + middle / np.linalg.norm(middle) * corner[2] / math.sin(half)
        path.append((here + reach * to_last, centre - middle / np.linalg.norm(middle) * corner[2], here + reach * to_next))
    work = W(plane, origin=origin).moveTo(*path[0][-1])
    for stop in path[1:] + path[:1]:
        work = work.lineTo(*stop[0])
        if len(stop) == 3:
            work = work.threePointArc(*stop[1:])
    return work.close()


def round_body(*corners):
    """A body of revolution round z from (r, z) or (r, z, radius of the corner)."""
    return outline(*corners, plane="XZ").revolve(360, (0, 0, 0), (0, 1, 0))


def sector(inner, outer, half, h, z=0.0):
    """A piece of a ring of height h, to both sides of the x axis by an angle."""
    ring = W("XY", origin=(0, 0, z)).moveTo(*radial(inner, -half)).threePointArc((inner, 0), radial(inner, half)).lineTo(*radial(outer, half))
    return ring.threePointArc((outer, 0), radial(outer, -half)).close().extrude(h)
