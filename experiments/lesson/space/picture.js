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
      this.faces.push({...Lesson.RunItems.faceOf(points, name, this.camera), layer});
    }

    // Puts the faces gathered so far into the scene.
    flush() {
      this.faces.sort((a, b) => Lesson.Replay.compare(a.order, b.order));
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
      const {run, run: {volume, shown}, camera} = this;
      run.surfaceTriangles ??= [...(volume.triangles ?? []).entries()];
      this.scene.onLayer(2).sheet(
          "surface", shown.facesOf("surface", run.surfaceTriangles, volume.points, "surfaceFace", camera));
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

    // Where there are many, only those in question have their numbers, `named`; where there are very many, only the
    // newest is seen.
    vertices(points, newest, named = []) {
      if (points.length <= 400) this.scene.onLayer(0).sheet("vertices", this.run.shown.verticesOf(points, this.camera));
      if (points[newest]) this.mark(points[newest], "disc", "vertex", 0, 5);
      const names = new Map([...named, newest].filter((v) => points[v]).map((v) => [v, 6]));
      // Names of what lies behind would be taken for those in front.
      const isInFront = (p) => this.camera.nearness(p) > -0.1 * this.camera.size;
      if (points.length <= 60) {
        points.forEach((p, v) => {
          if (!names.has(v) && isInFront(p)) names.set(v, 1 + this.camera.nearness(p) / 1000);
        });
      }
      for (const [v, weight] of names) this.label(points[v], String(v), weight);
    }

    triangulation(replay) {
      const {scene, camera, run: {shown}} = this;
      if (this.isShown(4)) scene.onLayer(4).sheet("edges", shown.edgesOf(replay, camera));
      this.restricted(replay);
      if (this.isShown(3))
        scene.onLayer(3).sheet("dualEdges", shown.dualEdgesOf(replay, (key) => this.dualEdge(replay, key), camera));
      if (this.isShown(6))
        scene.onLayer(6).sheet("hits", shown.hitsOf(replay, (key) => this.hitsOf(replay, key), camera));
    }

    restricted(replay) {
      this.mesh({points: replay.points, triangles: new Map(replay.restricted().map((f) => [f.join(), f]))});
    }

    // Of triangles, key -> corners.
    mesh({points, triangles}) {
      if (!this.isShown(5)) return;
      this.scene.onLayer(5).sheet("mesh", this.run.shown.facesOf("mesh", triangles, points, "meshFace", this.camera));
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
