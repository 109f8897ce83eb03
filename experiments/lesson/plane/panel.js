// The settings of the laboratory, and what the plane hides.
Lesson.planePanel = (() => {
  const {element} = Lesson;

  const hidden = [
    [
      "the cubic",
      "Along a line g is a quadratic in a cell of the plane, with at most two hits; in space a cubic, with three."
    ],
    ["r / l", "An edge has r / l = 1/2, always, so the criterion on the shape of triangles is silent here."],
    ["slivers", "Tetrahedra may be flat though their edges are long. No triangle of the plane is like that."],
    [
      "flips",
      "Of four points around a hole the plane leaves no choice of surface; in space edges of the mesh can be flipped."
    ],
    ["disks", "E is a path here and D two edges. In space E is a disk of any number of triangles, and D has two more."],
    [
      "the umbrella",
      "D_q is two edges here; in space a cycle of triangles, which can be pinched without any edge being odd."
    ],
    [
      "the boundary",
      "All samples on the border are below, so curves close. In space surfaces end at the box (section 5)."
    ],
  ];

  const labelled = (text, control) => element("label", {class: "setting"}, element("span", {}, text), control);

  const select = (laboratory) => element(
      "select", {onchange: (event) => laboratory.chooseField(event.target.value)},
      ...Lesson.fields.list.map(
          (field) =>
              element("option", {value: field.name, selected: field.name === laboratory.fieldName}, field.title)));

  const number = (value, attributes, set) => element("input", {
    type: "number",
    value,
    ...attributes,
    onchange: (event) => event.target.checkValidity() && event.target.value !== "" && set(Number(event.target.value)),
  });

  const option = (laboratory, text, name, attributes) =>
      labelled(text, number(laboratory.options[name], attributes, (value) => laboratory.setOption(name, value)));

  // For those who cannot drag: a sample by its numbers.
  const sampleForm = (laboratory) => {
    const {width, height} = laboratory.field;
    const i = number(Math.round(width / 2), {min: 1, max: width - 2, "aria-label": "sample x"}, () => read());
    const j = number(Math.round(height / 2), {min: 1, max: height - 2, "aria-label": "sample y"}, () => read());
    const value = number(0, {step: 0.1, "aria-label": "value less isovalue"}, (f) => {
      laboratory.setSample(Number(i.value), Number(j.value), f + laboratory.field.isovalue);
    });
    // Another field may be smaller.
    const read = () => (value.value = laboratory.field.sample(Number(i.value), Number(j.value)).toFixed(3));
    read();
    return element(
        "fieldset", {}, element("legend", {}, "A sample (or drag it up and down)"), labelled("x", i), labelled("y", j),
        labelled("g − κ", value));
  };

  const seeding = (laboratory) => element(
      "select", {onchange: (event) => laboratory.setOption("seeding", event.target.value)},
      element("option", {value: "random", selected: laboratory.options.seeding === "random"}, "random (paper)"),
      element(
          "option", {value: "components", selected: laboratory.options.seeding === "components"},
          "one on every loop, too"));

  return (laboratory) => {
    const values = element("input", {
      type: "checkbox",
      checked: laboratory.showsValues,
      onchange: (event) => {
        laboratory.showsValues = event.target.checked;
        laboratory.context.redraw();
      }
    });
    laboratory.exerciseBox = element("div", {}, ...laboratory.exercises().map(Lesson.exercise));
    return element(
        "div", {}, laboratory.exerciseBox, element("h2", {}, "The run"),
        element(
            "div", {class: "settings"}, labelled("field", select(laboratory)),
            labelled("seed", number(String(laboratory.seed), {min: 0, step: 1}, (seed) => laboratory.setSeed(seed))),
            option(laboratory, "start points", "start", {min: 0, max: 40, step: 1}),
            labelled("seeding", seeding(laboratory)),
            option(laboratory, "ε", "epsilon", {min: 0.02, max: 5, step: 0.01}),
            option(laboratory, "ε₁", "epsilon1", {min: 0.02, max: 5, step: 0.01}),
            option(laboratory, "ε₂", "epsilon2", {min: 0.05, max: 9, step: 0.05}),
            option(laboratory, "size bound", "sizeBound", {min: 0.02, max: 5, step: 0.01}),
            option(laboratory, "r_min", "rMin", {min: 0.005, max: 5, step: 0.001}), labelled("values", values)),
        sampleForm(laboratory),
        element(
            "p", {class: "soft"}, "Drag a start point along the curve, a sample up or down; the run follows at once."),
        element(
            "details", {}, element("summary", {}, "What the plane hides"),
            element(
                "dl", {}, ...hidden.flatMap(([term, text]) => [element("dt", {}, term), element("dd", {}, text)]))));
  };
})();
