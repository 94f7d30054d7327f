"""Patches of a mesh: the label of each triangle, and what is known of each patch and of each two that touch."""
import math

import numpy as np

from mesh import components
from surfaces import RECOGNISE
from unusable import Unusable


class Labels:
    """Patches: faces on one surface that share a mesh edge. Numbered as the faces of the solid are."""

    def __init__(self, faces, owner, pair):
        self.faces, self.owner = faces, owner
        met = np.unique(np.sort(owner[pair], axis=1), axis=0)
        self.met = met[met[:, 0] != met[:, 1]]
        joined = np.array([(a, b) for a, b in self.met if faces[a].same_surface(faces[b])]).reshape(-1, 2).astype(int)
        patch_of_face = components(len(faces), joined)[1]
        seen = np.unique(patch_of_face[owner])
        label_of = np.full(patch_of_face.max() + 1, -1)
        label_of[seen] = np.arange(len(seen))
        self.count, self.of_face = len(seen), label_of[patch_of_face]
        self.of_triangle = self.of_face[owner]

    def rows(self, p, triangles, areas, diagonal):
        """What the JSON says of each patch. Unusable where a vertex does not lie on its surface."""
        rows = []
        for label in range(self.count):
            mine = self.of_triangle == label
            lead = self.lead(label)
            row = {"label": label, "type": lead.type, "triangles": int(mine.sum()), "area": float(areas[mine].sum()), "parameters": {}}
            if lead.surface is not None:
                row["parameters"] = rounded(lead.surface.parameters(lead.sign))
                off = np.abs(lead.surface.residual(p[np.unique(triangles[mine])])[0]).max() / diagonal
                row["max_vertex_deviation"] = rounded(float(off), 3)
                if lead.type != "plane":
                    row["concave"] = bool(lead.sign < 0)
                if lead.recognised:
                    row["stored_as"] = lead.stored
                if off > RECOGNISE * 2:
                    raise Unusable(f"a vertex lies {off:.1e} of the diagonal off its {lead.type}")
            elif lead.type == "other":
                row["subtype"] = {"SurfaceOfRevolution": "revolution", "SurfaceOfExtrusion": "extrusion"}.get(lead.stored, "offset")
            rows.append(row)
        return rows

    def members(self, label):
        """The faces of a patch that have triangles."""
        return [i for i in np.flatnonzero(self.of_face == label) if (self.owner == i).any()]

    def lead(self, label):
        """The face whose surface stands for the patch: one the kernel stores as such, if there is one."""
        members = self.members(label)
        return self.faces[next((i for i in members if not self.faces[i].recognised), members[0])]

    def check_free_forms(self, p, triangles, diagonal, rng):
        """Unusable where a vertex does not lie on its face. Up to 200 vertices a face: projecting one is slow."""
        for index, face in enumerate(self.faces):
            if face.surface is None and (self.owner == index).any():
                some = rng.permutation(p[np.unique(triangles[self.owner == index])])[:200]
                off = max(face.distance(q) for q in some) / diagonal
                if off > RECOGNISE * 2:
                    raise Unusable(f"a vertex lies {off:.1e} of the diagonal off its {face.type} face")

    def problems(self):
        """In words: what of the labels is a matter of opinion."""
        problems = [f"face {i} has no triangles" for i in range(len(self.faces)) if not (self.owner == i).any()]
        near = {}
        for label in range(self.count):
            lead = self.lead(label)
            if lead.near:
                near.setdefault((lead.type, lead.near[0]), []).append((label, lead.near[1]))
        for (kind, other), found in near.items():
            problems.append(f"{kind} patches {', '.join(str(label) for label, _ in found)} are within "
                            f"{max(off for _, off in found):.1e} of the diagonal of a {other}")
        for a, b in self.met:
            if self.of_face[a] != self.of_face[b] and self.faces[a].same_surface(self.faces[b], 1e-4):
                problems.append(f"patches {self.of_face[a]} and {self.of_face[b]} are nearly one {self.faces[a].type}")
        return problems


def adjacency(p, pair, ends, labels, owner, faces, patches):
    """One row for each two patches that share mesh edges. `pair`, `ends`: those edges; `p`: vertices."""
    cache = {}

    def normal(face, vertex):
        if (face, vertex) not in cache:
            cache[face, vertex] = np.array(faces[face].normal_near(p[vertex]))
        return cache[face, vertex]

    rows = {}
    for (s, t), (a, b) in zip(pair, ends):
        angles = [math.degrees(2 * math.asin(min(1.0, np.linalg.norm(normal(owner[s], v) - normal(owner[t], v)) / 2)))
                  for v in (a, b)]
        rows.setdefault(tuple(sorted((int(labels[s]), int(labels[t])))), []).append((float(np.linalg.norm(p[a] - p[b])), angles))
    result = []
    for key, edges in sorted(rows.items()):
        length = sum(edge[0] for edge in edges)
        known = [(edge[0], np.nanmean(edge[1])) for edge in edges if np.isfinite(edge[1]).any()]
        row = {"patches": list(key), "length": rounded(length, 6), "smooth": None, "smooth_share": None,
               "angle_min": None, "angle_max": None}
        if known:
            share = sum(l for l, angle in known if angle <= 2) / sum(l for l, _ in known)
            values = np.concatenate([edge[1] for edge in edges])
            row |= {"smooth": bool(share >= 0.95), "smooth_share": round(share, 3),
                    "angle_min": round(float(np.nanmin(values)), 3), "angle_max": round(float(np.nanmax(values)), 3)}
            if row["smooth"] and all(patches[k]["type"] in ("bspline", "other") for k in key):
                row["free_form"] = True
        result.append(row)
    return result


def rounded(value, digits=9):
    """Numbers to so many digits that count, in dicts and lists too."""
    if isinstance(value, dict):
        return {k: rounded(v, digits) for k, v in value.items()}
    if isinstance(value, list):
        return [rounded(v, digits) for v in value]
    return float(f"{value:.{digits}g}")
