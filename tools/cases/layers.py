"""Layers of prisms and hexes grown from a surface mesh along one direction per vertex."""
from itertools import combinations

import numpy as np

# Corners with a normalised volume below this are taken as folded, and the column is shortened.
LEAST_CORNER = 0.02


def corner_normals(points, mesh):
    """For every corner of every face: its vertex and the unit normal of the face there."""
    vertex, normal = [], []
    for faces in (mesh.triangles, mesh.quads):
        n = faces.shape[1]
        for i in range(n):
            here, after, before = faces[:, i], faces[:, (i + 1) % n], faces[:, i - 1]
            cross = np.cross(points[after] - points[here], points[before] - points[here])
            vertex.append(here)
            normal.append(cross / np.maximum(np.linalg.norm(cross, axis=1), 1e-300)[:, None])
    return np.concatenate(vertex), np.vstack(normal)


def central_direction(normals):
    """The axis of the narrowest cone that holds the unit vectors `normals` (k,3)."""
    best, best_cosine = normals[0], -1.0
    axes = [normals.mean(axis=0)] + [a + b for a, b in combinations(normals, 2)]
    axes += [np.cross(b - a, c - a) for a, b, c in combinations(normals, 3)]
    for axis in axes:
        length = np.linalg.norm(axis)
        if length < 1e-12:
            continue
        for candidate in (axis / length, -axis / length):
            cosine = (normals @ candidate).min()
            if cosine > best_cosine + 1e-9:
                best, best_cosine = candidate, cosine
    return best


def growth_directions(mesh, planes):
    """One unit vector a vertex; where `planes` (vertex -> unit normal) holds it, within that plane."""
    vertex, normal = corner_normals(mesh.points, mesh)
    order = np.argsort(vertex, kind="stable")
    starts = np.searchsorted(vertex[order], np.arange(len(mesh.points) + 1))
    directions = np.zeros_like(mesh.points)
    for v in range(len(mesh.points)):
        around = normal[order[starts[v]:starts[v + 1]]]
        if v in planes:
            around = around - np.outer(around @ planes[v], planes[v])
            around /= np.linalg.norm(around, axis=1)[:, None]
        directions[v] = central_direction(around)
    return directions


def limit_growth(height, mesh, slope):
    """Lowers heights until neighbours differ by at most slope x edge length."""
    a, b = mesh.edges.T
    allowance = slope * mesh.edge_lengths()
    for _ in range(40):
        limited = height.copy()
        np.minimum.at(limited, a, height[b] + allowance)
        np.minimum.at(limited, b, height[a] + allowance)
        if np.array_equal(limited, height):
            break
        height = limited
    return height


def layer_heights(first, total, count):
    """(n, count+1) heights: first cell `first`, constant growth a column, top at `total`."""
    low, high = np.full(len(total), 1.0 + 1e-9), np.full(len(total), 20.0)
    for _ in range(80):
        ratio = (low + high) / 2
        too_high = first * (ratio**count - 1) / (ratio - 1) > total
        high, low = np.where(too_high, ratio, high), np.where(too_high, low, ratio)
    ratio = ((low + high) / 2)[:, None]
    return first * (ratio ** np.arange(count + 1) - 1) / (ratio - 1)


def folded_vertices(levels, mesh):
    """Vertices of any layer cell with a corner that is flat, inverted or against the wall's normal."""
    folded = np.zeros(len(levels), bool)
    for faces in (mesh.triangles, mesh.quads):
        n = faces.shape[1]
        for k in range(levels.shape[1] - 1):
            low, high = levels[faces, k], levels[faces, k + 1]
            for i in range(n):
                for base in (low, high):
                    along = base[:, (i + 1) % n] - base[:, i]
                    back = base[:, i - 1] - base[:, i]
                    up = high[:, i] - low[:, i]
                    area = np.cross(along, back)
                    volume = np.einsum("ei,ei->e", area, up)
                    scale = np.linalg.norm(area, axis=1) * np.linalg.norm(up, axis=1)
                    folded[faces[volume < LEAST_CORNER * scale].ravel()] = True
    wall, top = (corner_normals(levels[:, k], mesh) for k in (0, -1))
    turned = np.einsum("ei,ei->e", wall[1], top[1]) < 0.3
    folded[wall[0][turned]] = True
    return folded


def grow(mesh, count, first, reach, planes):
    """Levels (n, count+1, 3) above every vertex: first cell `first`, total about reach x local edge."""
    directions = growth_directions(mesh, planes)
    lengths = mesh.edge_lengths()
    shortest, total, valence = np.full(len(mesh.points), np.inf), *np.zeros((2, len(mesh.points)))
    for end in mesh.edges.T:
        np.minimum.at(shortest, end, lengths)
        np.add.at(total, end, lengths)
        np.add.at(valence, end, 1)
    least = first * count * 1.05
    height = limit_growth(np.maximum(reach * np.sqrt(shortest * total / valence), least), mesh, 0.4)
    for _ in range(60):
        heights = layer_heights(first, height, count)
        levels = mesh.points[:, None] + directions[:, None] * heights[:, :, None]
        folded = folded_vertices(levels, mesh)
        if not folded.any():
            return levels
        height[folded] = np.maximum(0.75 * height[folded], least)
        height = np.maximum(limit_growth(height, mesh, 0.4), least)
    raise RuntimeError(f"{folded.sum()} columns fold even at their least height")
