// Draws states of a run in space: faces from the farthest to the nearest, with lines and marks over them.
Lesson.SpacePicture = (() => {
  const {vectors} = Lesson;

  const layers = {
    1: "box, slice",
    2: "surface",
    3: "Voronoi",
    4: "Delaunay",
    5: "mesh",
    6: "hits",
    7: "conflict, E",
    8: "rim, D",
    9: "poles"
  };

  class SpacePicture {
    // Of layers that are not shown nothing is drawn; null: all are.
    constructor(run, camera, layers = null) {
      Object.assign(this, {run, camera, layers});
      this.faces = [];
      this.scene = new Lesson.Scene(camera.bounds());
    }

    isShown(layer) { return layer === 0 || this.layers === null || this.layers.has(layer); }

    face(points, name, layer) {
      if (!this.isShown(layer)) return;
      const {camera} = this;
      const normal = vectors.cross(vectors.sub(points[1], points[0]), vectors.sub(points[2], points[0]));
      this.faces.push({
        points: points.map((p) => camera.toPlane(p)),
        layer,
        role: `${name}${Lesson.shadeOf(normal, camera.towards)}`,
        nearness: camera.nearness(vectors.mean(points))
      });
    }

    // Puts the faces gathered so far into the scene.
    flush() {
      this.faces.sort(
          (a, b) => a.nearness - b.nearness || Lesson.Replay.compare(a.points[0], b.points[0]) ||
              Lesson.Replay.compare(a.points[1], b.points[1]));
      for (const {points, role, layer} of this.faces) this.scene.onLayer(layer).polygon(points, role);
      this.faces = [];
    }

    line(points, role, layer) {
      if (this.isShown(layer)) this.scene.onLayer(layer).line(points.map((p) => this.camera.toPlane(p)), role);
    }

    mark(p, shape, role, layer, size) {
      if (this.isShown(layer)) this.scene.onLayer(layer).mark(this.camera.toPlane(p), shape, role, size);
    }

    label(p, text, weight, layer = 0) {
      this.scene.onLayer(layer).label(this.camera.toPlane(p), text, "label", weight);
    }

    // The box of the voxel cells from low to high.
    box(low, high, role, layer) {
      const {step} = this.run.volume;
      const corner = (bits) => [0, 1, 2].map((axis) => ((bits >> axis) & 1 ? high[axis] + 1 : low[axis]) * step[axis]);
      this.edgesOfBox(corner, role, layer);
    }

    edgesOfBox(corner, role, layer) {
      for (let bits = 0; bits < 8; ++bits) {
        for (let axis = 0; axis < 3; ++axis) {
          if (!((bits >> axis) & 1)) this.line([corner(bits), corner(bits | (1 << axis))], role, layer);
        }
      }
    }

    // The box of the volume, the slice and the surface itself.
    context(sliceAt) {
      const {volume, box: [low, high]} = this.run;
      const corner = (bits) => [0, 1, 2].map((axis) => ((bits >> axis) & 1 ? high : low)[axis]);
      this.edgesOfBox(corner, "frame", 1);
      if (this.isShown(2)) this.surface();
      if (sliceAt !== null) {
        for (const line of Lesson.slice.curves(volume, sliceAt)) this.line(line, "slice", 1);
      }
    }

    // The surface looks the same until the reader turns it.
    surface() {
      const {run: {volume}, camera, scene} = this;
      const seen = this.run.surfaceSeen;
      if (seen?.turn === camera.turn && seen.tilt === camera.tilt) {
        for (const item of seen.items) scene.items.push(item);
        return;
      }
      const first = scene.items.length;
      for (const t of volume.triangles ?? []) this.face(t.map((v) => volume.points[v]), "surfaceFace", 2);
      this.flush();
      this.run.surfaceSeen = {turn: camera.turn, tilt: camera.tilt, items: scene.items.slice(first)};
    }

    // Where the dual edge of a facet ends: at circumcenters, and towards infinity at the rim of the picture.
    dualEdge(replay, key) {
      const facet = key.split(",").map(Number).map((v) => replay.points[v]);
      return replay.sidesOf(key).map((tetKey) => {
        const {v} = replay.tets.get(tetKey);
        if (v.some((corner) => corner < 0)) return this.rayEnd(replay, key, facet);
        return this.clampTo(facet, vectors.circumcenter(v.map((corner) => replay.points[corner])));
      });
    }

    rayEnd(replay, key, facet) {
      const {center, normal} = vectors.circumcircle(facet);
      const inner = replay.sidesOf(key).map((k) => replay.tets.get(k).v).find((v) => !v.some((c) => c < 0));
      const corners = new Set(key.split(",").map(Number));
      const far = inner && replay.points[inner.find((v) => !corners.has(v))];
      const side = far && vectors.dot(vectors.sub(far, facet[0]), normal) > 0 ? -1 : 1;
      return vectors.add(center, vectors.scale(side * 0.3 * this.camera.size, normal));
    }

    // Circumcenters may lie far out; the edge is drawn as far as the picture goes.
    clampTo(facet, end) {
      const {center} = vectors.circumcircle(facet);
      const way = vectors.sub(end, center);
      const most = 0.45 * this.camera.size;
      const length = vectors.norm(way);
      return length > most ? vectors.add(center, vectors.scale(most / length, way)) : end;
    }

    hitsOf(replay, key) {
      const found = replay.hits.get(key);
      if (!found) return [];
      const {center, normal} = vectors.circumcircle(found.v.map((v) => replay.points[v]));
      return found.t.map((t) => vectors.add(center, vectors.scale(t, normal)));
    }

    vertices(points, newest) {
      points.forEach((p, v) => {
        const isNew = v === newest;
        this.mark(p, "disc", "vertex", 0, isNew ? 5 : 2.2);
        // Names of what lies behind would be taken for those in front.
        const isInFront = this.camera.nearness(p) > -0.1 * this.camera.size;
        if (isNew || (isInFront && points.length <= 160)) {
          this.label(p, String(v), isNew ? 6 : 1 + this.camera.nearness(p) / 1000);
        }
      });
    }

    triangulation(replay) {
      if (this.isShown(4)) {
        for (const [a, b] of SpacePicture.edgesOf(replay))
          this.line([replay.points[a], replay.points[b]], "delaunay", 4);
      }
      const facets = replay.restricted();
      for (const f of facets) this.face(f.map((v) => replay.points[v]), "meshFace", 5);
      this.flush();
      if (!this.isShown(3) && !this.isShown(6)) return;
      for (const f of facets) {
        const key = Lesson.Replay.keyOf(f);
        this.line(this.dualEdge(replay, key), "voronoi", 3);
        for (const p of this.hitsOf(replay, key)) this.mark(p, "cross", "hit", 6, 4);
      }
    }

    // The edges between vertices that are points of the surface, each once, sorted.
    static edgesOf(replay) {
      const size = replay.points.length;
      const numbers = new Set();
      for (const {v} of replay.tets.values()) {
        const finite = v.filter((corner) => !replay.isVirtual(corner));
        for (const a of finite)
          for (const b of finite)
            if (a < b) numbers.add(a * size + b);
      }
      return [...numbers].sort((a, b) => a - b).map((number) => [Math.floor(number / size), number % size]);
    }

    mesh({points, triangles}) {
      for (const t of triangles.values()) this.face(t.map((v) => points[v]), "meshFace", 5);
      this.flush();
    }

    // Faces of some tetrahedra, each drawn around its own middle, which moves outwards with `explode`.
    tets(all, points, middle, explode, name, layer) {
      for (const v of all) {
        const finite = v.filter((corner) => corner >= 0).map((corner) => points[corner]);
        const out = vectors.scale(explode, vectors.sub(vectors.mean(finite), middle));
        const moved = finite.map((p) => vectors.add(p, out));
        const faces = moved.length === 3 ? [[0, 1, 2]] : [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]];
        for (const f of faces) this.face(f.map((i) => moved[i]), name, layer);
      }
      this.flush();
    }
  }

  SpacePicture.layers = layers;
  return SpacePicture;
})();
