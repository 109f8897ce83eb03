// Words of the glossary, and the flattened umbrellas.
(() => {
  const {test, check, equal} = Lesson.selftest;

  test("words are explained once, and say the same as before", () => {
    const words = Lesson.glossary.read();
    check(words.size > 25, `${words.size} words`);
    const box =
        Lesson.element("div", {}, "Poles and a pole; the ", Lesson.element("b", {}, "pole height"), ", isosurfaces");
    const before = box.textContent;
    Lesson.glossary.mark(box, new Set(), ["isosurface"]);
    equal(box.textContent, before, "text");
    equal([...box.querySelectorAll("dfn")].map((term) => term.textContent), ["Poles", "pole height"], "terms");
    for (const term of box.querySelectorAll("dfn")) {
      equal(term.tabIndex, 0, "Tab reaches it");
      check(term.getAttribute("aria-description").length > 20, "its meaning");
    }
  });

  test("a word that has the focus shows its meaning, and Escape hides it", () => {
    const {tip} = Lesson.glossary;
    const box = Lesson.element("p", {}, "a facet");
    document.body.append(box, tip);
    Lesson.glossary.mark(box, new Set());
    const [term] = box.querySelectorAll("dfn");
    term.dispatchEvent(new Event("focus"));
    check(!tip.hidden && tip.textContent.includes("tetrahedron"), tip.textContent);
    term.dispatchEvent(new KeyboardEvent("keydown", {key: "Escape"}));
    check(tip.hidden, "hidden");
    box.remove();
  });

  test("links of umbrellas are cycles, paths, or broken", () => {
    const kinds = (facets) => Lesson.link.of(facets, 0).map(
        ({vertices, isCycle, isPath}) =>
            [isCycle    ? "cycle" :
                 isPath ? "path" :
                          "branches",
             vertices.length]);
    equal(kinds([[0, 1, 2], [0, 2, 3], [0, 1, 3]]), [["cycle", 3]], "a disk");
    equal(kinds([[0, 1, 2], [3, 0, 2]]), [["path", 3]], "a half disk");
    equal(
        kinds([[0, 1, 2], [0, 2, 3], [0, 1, 3], [0, 4, 5], [0, 5, 6], [6, 0, 4]]), [["cycle", 3], ["cycle", 3]],
        "a pinch");
    equal(kinds([[0, 1, 2], [0, 1, 3], [0, 1, 4]]), [["branches", 4]], "three at an edge");
    equal(Lesson.link.of([[0, 5, 1], [0, 1, 3], [0, 3, 5]], 0)[0].vertices.length, 3, "in order");
  });

  // The program inserts a point for an umbrella just where its link is no cycle, nor a path at the box.
  test("umbrellas that ExtractManifold mends are broken", () => {
    for (const {events, box} of (Lesson.data.runs ?? []).map((data) => new Lesson.SpaceRun(data))) {
      const points = [...(events[0].points ?? [])];
      for (const event of events) {
        if (event.e !== "insert") continue;
        if (event.why === "extract_manifold" && event.disk.length) {
          const pieces = Lesson.link.of(event.disk, event.q);
          const isOnBox =
              points[event.q].some((x, axis) => Math.abs(x - box[0][axis]) < 1e-4 || Math.abs(x - box[1][axis]) < 1e-4);
          const isWhole = pieces.length === 1 && (pieces[0].isCycle || (pieces[0].isPath && isOnBox));
          check(!isWhole || isOnBox, `the umbrella of ${event.q} is a disk`);
        }
        points[event.v] = event.p;
      }
    }
  });
})();
