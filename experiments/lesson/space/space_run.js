// A run of the program with what its chapters share: the trace, its replay, and where the reader stands.
Lesson.SpaceRun = class {
  // As the page's data have it.
  constructor({name, volume: packed, events: packedEvents, limits, rays, cells, left_out: leftOut}) {
    const {listOf, eventsOf} = Lesson.columns;
    const events = eventsOf(packedEvents);
    const volume = {dims: packed.dims, step: packed.step};
    for (const key of ["samples", "points", "triangles"]) volume[key] = packed[key] ? listOf(packed[key]) : [];
    Object.assign(this, {name, volume, events, leftOut, rays: rays ?? [], cells: cells ?? []});
    const last = volume.dims.map((count, axis) => (count - 1) * volume.step[axis]);
    this.box = [[0, 0, 0], last];
    this.camera = new Lesson.Camera(Lesson.boxOf(volume.points?.length ? volume.points : this.box));
    this.meshAt = events.findIndex((event) => event.e === "mesh");
    // A run that keeps its tetrahedra to the end (full3d), or was stopped before, has no mesh of triangles alone.
    this.hasStage2 = this.meshAt >= 0;
    this.endOfStage1 = this.hasStage2 ? this.meshAt : events.length;
    this.replay = new Lesson.Replay(events, 0, 200);
    // Stage 2 stands on the mesh that it begins with, so that nobody has to go through stage 1 to get to it.
    this.replayOfStage2 = this.hasStage2 ? new Lesson.Replay(events, this.meshAt, 1500) : this.replay;
    // The search for a state goes its own way, while the reader goes his.
    this.searching = new Lesson.Replay(events);
    this.shown = new Lesson.RunItems();
    this.limits = {...limits, ...(this.hasStage2 ? events[this.meshAt].limits : {})};
    this.end = events[events.length - 1];
    // Without the certificate, and where the run was stopped, nobody has looked for the exact topology.
    this.isChecked = (this.end.isosurface ?? []).length > 0;
  }

  // The replay after an event; the last event that is no state of its own shows the one before.
  at(event) {
    const n = Math.max(0, event);
    return (n >= this.endOfStage1 ? this.replayOfStage2 : this.replay).goTo(n);
  }

  // What the restricted facets are after an event of stage 1, as BuildTriMesh would take them.
  complex(event, replay = this.replay) {
    this.complexes ??= new Map();
    if (!this.complexes.has(event))
      this.complexes.set(event, Lesson.restrictedComplex(replay.goTo(event), this.volume));
    return this.complexes.get(event);
  }

  // Of the exact surface, all components together.
  exact() {
    const sum = {chi: 0, components: 0};
    for (const {chi, count} of this.end.isosurface ?? []) {
      sum.chi += chi * count;
      sum.components += count;
    }
    return sum;
  }

  // The first event of stage 1 after which the Euler characteristic and the number of components are right; -1: none.
  homeomorphicAt() {
    while (!this.searchHomeomorphic(Infinity)) continue;
    return this.firstRight;
  }

  // Looks for it until some time (of performance.now()), and says whether it is known now.
  searchHomeomorphic(until) {
    const {chi, components} = this.exact();
    this.searched ??= 0;
    while (this.firstRight === undefined) {
      if (performance.now() >= until) return false;
      const i = this.searched++;
      if (i >= this.endOfStage1 || !this.isChecked) {
        this.firstRight = -1;
      } else if (this.events[i].e === "initial" || this.events[i].e === "insert") {
        const found = this.complex(i, this.searching);
        if (found.chi === chi && found.components === components && !found.open) this.firstRight = i;
      }
    }
    return true;
  }
};
