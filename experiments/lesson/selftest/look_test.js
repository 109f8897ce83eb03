// What can be read: contrast, room for labels, and no motion where none is wanted.
(() => {
  const {test, check, equal} = Lesson.selftest;

  // Relative luminance and contrast, as WCAG defines them.
  const luminance = (hex) => {
    const channels = [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);
    const [r, g, b] = channels.map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };

  const contrast = (a, b) => {
    const [dark, light] = [luminance(a), luminance(b)].sort((s, t) => s - t);
    return (light + 0.05) / (dark + 0.05);
  };

  test("texts and lines stand out from the paper", () => {
    for (const [name, colours] of Object.entries(Lesson.theme.colours)) {
      for (const text of ["ink", "soft", "blue", "red"]) {
        const ratio = contrast(colours[text], colours.paper);
        check(ratio >= 4.5, `${name}: ${text} has a contrast of ${ratio.toFixed(2)}`);
      }
      for (const line of ["green", "orange", "purple", "sky", "above", "below"]) {
        const ratio = contrast(colours[line], colours.paper);
        check(ratio >= 3, `${name}: ${line} has a contrast of ${ratio.toFixed(2)}`);
      }
    }
  });

  test("kinds of steps differ by their marks, not by colour alone", () => {
    for (const chapter of Lesson.chapters.filter((other) => other.kinds)) {
      const marks = Object.values(chapter.kinds).filter((kind) => kind.key).map((kind) => kind.mark);
      equal(marks.length, new Set(marks).size, `${chapter.name}: ${marks}`);
      const keys = Object.values(chapter.kinds).filter((kind) => kind.key).map((kind) => kind.key);
      equal(keys.length, new Set(keys).size, `${chapter.name}: ${keys}`);
    }
  });

  // Labels are placed by an estimate of their width, which must not be too small.
  test("labels are no wider than their boxes", () => {
    const context = document.createElement("canvas").getContext("2d");
    context.font = "13px system-ui, sans-serif";
    for (const text
             of ["0", "12", "128", "next", "missed", "12: not in E", "p, edge 26", "t = 0", "−0.35", "right",
                 "yours"]) {
      const {width} = context.measureText(text);
      const box = Lesson
                      .placeLabels(
                          [{point: [0, 0], text, role: "label", weight: 1}],
                          {width: 400, height: 400, toScreen: () => [200, 200]}, 13)[0]
                      .box;
      check(width <= box.right - box.left, `"${text}" has ${width} pixels, its box ${box.right - box.left}`);
    }
  });

  // The reader's wish, granted for the length of a test.
  const withLessMotion = (run) => {
    const before = window.matchMedia;
    window.matchMedia = (query) => query.includes("reduced-motion") ? {matches: true} : before.call(window, query);
    try {
      run();
    } finally {
      window.matchMedia = before;
    }
  };

  test("with less motion nothing plays by itself", () => {
    const chapter = new Lesson.Laboratory("1");
    const player = new Lesson.Player(chapter, () => {});
    withLessMotion(() => player.command("play"));
    equal(player.timer, null, "no clock runs");
    const kinds = chapter.steps().map((step) => step.kind);
    equal(player.step, kinds.findIndex((kind, i) => i > 0 && kind !== kinds[0]), "on to another kind");
    player.command("play");
    check(player.timer !== null, "else it plays");
    player.command("next");
    equal(player.timer, null, "until another key stops it");
  });
})();
