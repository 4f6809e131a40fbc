"""Rays cast at the meshes through random pixels: what the passes are checked against, by other code than the renderer's."""
import bpy
import numpy as np
from mathutils import Vector
from mathutils.bvhtree import BVHTree


class Meshes:
    """All visible parts' triangles in the world, on one frame."""

    def __init__(self, stage, frame):
        stage.scene.frame_set(frame)
        depsgraph = bpy.context.evaluated_depsgraph_get()
        vertices, triangles, owners, uv, normals, first = [], [], [], [], [], 0
        for part in stage.parts:
            if part.hidden:
                continue
            o = part.object.evaluated_get(depsgraph)
            data = o.to_mesh()
            count = len(data.vertices)
            local = np.empty(3 * count, np.float32)
            data.vertices.foreach_get("co", local)
            world = np.array(o.matrix_world)
            vertices.append(local.reshape(-1, 3) @ world[:3, :3].T + world[:3, 3])
            normals.append(corner_normals(data, world))
            o.to_mesh_clear()
            triangles.append(part.mesh.triangles + first)
            owners.append(np.full(len(part.mesh.triangles), part.id))
            uv.append(part.mesh.uv)
            first += count
        self.vertices, self.triangles = np.concatenate(vertices), np.concatenate(triangles)
        self.owners, self.uv = np.concatenate(owners), np.concatenate(uv)
        self.normals = np.concatenate(normals)
        self.tree = BVHTree.FromPolygons(self.vertices.tolist(), self.triangles.tolist(), all_triangles=True)
        self.pose = np.array(stage.camera.matrix_world)

    def cast(self, direction):
        """`direction` in the world, from the camera: (place, triangle) or None."""
        place, _, triangle, _ = self.tree.ray_cast(Vector(self.pose[:3, 3]), Vector(direction))
        return None if place is None else (np.array(place), triangle)

    def sees(self, point, tolerance):
        """Whether nothing stands between the camera and `point`."""
        to = point - self.pose[:3, 3]
        far = np.linalg.norm(to)
        hit = self.cast(to / far)
        return hit is None or np.linalg.norm(hit[0] - self.pose[:3, 3]) > far - tolerance


def corner_normals(data, world):
    """(triangles, 3, 3): the normals that shading interpolates, in the world."""
    data.calc_normals_split()
    normals = np.empty(3 * len(data.loops), np.float32)
    data.loops.foreach_get("normal", normals)
    turned = normals.reshape(-1, 3) @ np.linalg.inv(world[:3, :3])  # by the inverse, transposed
    return (turned / np.linalg.norm(turned, axis=1, keepdims=True)).reshape(-1, 3, 3)


def weights(corners, point):
    """Barycentric coordinates of a point in a triangle's plane."""
    a, b = corners[1] - corners[0], corners[2] - corners[0]
    v, w = np.linalg.lstsq(np.stack([a, b], 1), point - corners[0], rcond=None)[0]
    return np.array([1 - v - w, v, w])


def project(pose, focal_px, size, point):
    """Pixel coordinates (a pixel's centre is at .5) and z, along the viewing axis."""
    local = np.linalg.inv(pose) @ np.append(point, 1)
    z = -local[2]
    return size[0] / 2 + focal_px * local[0] / z, size[1] / 2 - focal_px * local[1] / z, z


def probe(stage, camera, frames, count, rng):
    """Records for `count` random pixels of each frame; where a ray hits nothing, the id is 0 and no more is known."""
    focal, (width, height) = camera["focal_px"], stage.size
    records = []
    for frame in frames:
        now, last, next_ = Meshes(stage, frame), Meshes(stage, frame - 1), Meshes(stage, frame + 1)
        for x, y in zip(rng.integers(0, width, count), rng.integers(0, height, count)):
            local = np.array([(x + 0.5 - width / 2) / focal, (height / 2 - y - 0.5) / focal, -1.0])
            direction = now.pose[:3, :3] @ local
            hit = now.cast(direction / np.linalg.norm(direction))
            record = {"frame": frame, "x": int(x), "y": int(y), "id": 0}
            if hit is not None:
                record.update(seen_by_ray(now, last, next_, hit, focal, stage.size))
            records.append(record)
    return records


def seen_by_ray(now, last, next_, hit, focal, size):
    place, triangle = hit
    corners = now.vertices[now.triangles[triangle]]
    share = weights(corners, place)
    normal = share @ now.normals[triangle]
    found = {"id": int(now.owners[triangle]), "position": place.tolist(), "depth": project(now.pose, focal, size, place)[2],
             "normal": (normal / np.linalg.norm(normal)).tolist(), "uv": (share @ now.uv[triangle]).tolist()}
    for name, other in (("forward", next_), ("backward", last)):
        there = share @ other.vertices[other.triangles[triangle]]
        x, y, z = project(other.pose, focal, size, there)
        found[name] = [x, y]
        inside = 0 <= x < size[0] and 0 <= y < size[1] and z > 0
        found[name + "_seen"] = bool(inside and other.sees(there, 2e-3 * z))
    return found
