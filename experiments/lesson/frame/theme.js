// What things look like. A picture names roles, never colours, so that one drawing serves dark and light pages, the
// screen and the slide. Colours are those of Okabe and Ito, which the colour-blind tell apart; what has to be told
// apart differs in width, dash or mark as well.
Lesson.theme = (() => {
  const colours = {
    light: {
      paper: "#ffffff",
      ink: "#1a1a1a",
      soft: "#6b6b6b",
      faint: "#c9c9c9",
      blue: "#0072b2",
      sky: "#3a8fc0",
      green: "#007a58",
      orange: "#c77c00",
      red: "#c04a00",
      purple: "#a8487e",
      above: "#0072b2",
      below: "#8a8a8a",
    },
    dark: {
      paper: "#14171a",
      ink: "#f2f2f2",
      soft: "#a6adb3",
      faint: "#4a5157",
      blue: "#56b4e9",
      sky: "#8fcdf2",
      green: "#2fc79b",
      orange: "#e69f00",
      red: "#ff8a4c",
      purple: "#e08fbd",
      above: "#56b4e9",
      below: "#8f979d",
    },
  };

  // stroke and fill name colours; width and dash are in CSS pixels.
  const roles = {
    grid: {stroke: "faint", width: 1},
    cell: {fill: "sky", fillOpacity: 0.18},
    above: {fill: "above", stroke: "above", width: 1},
    below: {stroke: "below", fill: "paper", width: 1.2},
    surface: {stroke: "soft", width: 5, opacity: 0.45},
    voronoi: {stroke: "green", width: 1, dash: [2, 3]},
    delaunay: {stroke: "soft", width: 1},
    forgotten: {stroke: "faint", width: 1, dash: [3, 5]},
    restricted: {stroke: "blue", width: 3},
    mesh: {stroke: "blue", width: 3},
    vertex: {fill: "ink", stroke: "paper", width: 1},
    hit: {stroke: "red", width: 2},
    conflict: {fill: "orange", fillOpacity: 0.22},
    rim: {stroke: "orange", width: 2.5, dash: [7, 4]},
    star: {stroke: "orange", width: 1.4},
    pole: {stroke: "purple", fill: "purple", width: 1.5},
    poleLine: {stroke: "purple", width: 1, dash: [1, 3]},
    ball: {stroke: "red", width: 1.4, dash: [4, 3]},
    dualEdge: {stroke: "green", width: 3, dash: [9, 4]},
    target: {stroke: "red", width: 4, dash: [12, 3]},
    point: {stroke: "red", fill: "paper", width: 2.5},
    pathE: {stroke: "red", width: 5, dash: [8, 4]},
    pathD: {stroke: "green", width: 3, dash: [3, 3]},
    wrong: {stroke: "red", width: 3, dash: [2, 2]},
    right: {stroke: "green", width: 3},
    label: {text: "ink"},
    softLabel: {text: "soft"},
    multi: {stroke: "red", fill: "red", width: 1.6},
    extract: {stroke: "orange", fill: "orange", width: 1.6},
    approximate: {stroke: "blue", fill: "blue", width: 1.6},
    poles: {stroke: "purple", fill: "purple", width: 1.6},
    refine: {stroke: "green", fill: "green", width: 1.6},
    plain: {stroke: "soft", fill: "soft", width: 1.6},
    refused: {stroke: "ink", width: 2},
    cursor: {stroke: "ink", width: 2},
  };

  let choice = "auto";

  const isDark = () =>
      choice === "dark" || (choice === "auto" && window.matchMedia("(prefers-color-scheme: dark)").matches);

  const colour = (name, dark) => colours[dark ? "dark" : "light"][name];

  // The style of a role with its colours looked up.
  const style = (role, dark) => {
    const plain = roles[role];
    if (!plain) throw new Error(`no role "${role}" in the theme`);
    return {
      stroke: plain.stroke ? colour(plain.stroke, dark) : null,
      fill: plain.fill ? colour(plain.fill, dark) : null,
      text: plain.text ? colour(plain.text, dark) : null,
      width: plain.width ?? 1,
      dash: plain.dash ?? [],
      opacity: plain.opacity ?? 1,
      fillOpacity: plain.fillOpacity ?? 1,
    };
  };

  // The style sheet reads the colours as variables.
  const apply = () => {
    const dark = isDark();
    const root = document.documentElement;
    root.dataset.theme = dark ? "dark" : "light";
    for (const [name, value] of Object.entries(colours[root.dataset.theme])) root.style.setProperty(`--${name}`, value);
  };

  const choose = (name) => {
    choice = name;
    apply();
  };

  return {roles, colours, colour, style, isDark, apply, choose};
})();
