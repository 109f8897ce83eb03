// The cards beside the picture: what happened, what comes next and why, the paper's lines, the layers. Each draws
// itself anew into its element; none keeps a state.
Lesson.cards = (() => {
  const {element} = Lesson;

  // A mark as it stands on the timeline, as a picture in the text.
  const markIcon = (kind) => {
    const style = Lesson.theme.style(kind.role, Lesson.theme.isDark());
    const painter = new Lesson.SvgPainter(16, 16, "none");
    for (const stroke of Lesson.markStrokes(kind.mark, 8, 8, 6)) painter.path(stroke.points, stroke.closed, style);
    const holder = element("span", {class: "icon", "aria-hidden": "true"});
    holder.innerHTML = painter.finish("");
    return holder;
  };

  const now = (card, chapter, step) => {
    const steps = chapter.steps();
    card.replaceChildren(
        element("h2", {}, `Step ${step} of ${steps.length - 1}`),
        element("p", {class: "sentence"}, markIcon(chapter.kinds[steps[step].kind]), chapter.sentence(step)),
        ...(chapter.status ? [element("p", {class: "soft"}, chapter.status(step))] : []));
  };

  const next = (card, chapter, step) => {
    const coming = chapter.next(step);
    card.replaceChildren(element("h2", {}, "Next"));
    if (!coming)
      card.append(element("p", {}, "The run has ended."));
    else
      card.append(element("p", {}, markIcon(chapter.kinds[coming.kind]), coming.sentence));
  };

  // The question instead of the answer.
  const question = (card, chapter, step, predict, answer) => {
    const choices = chapter.choices?.(step);
    const buttons = Object.entries(chapter.kinds)
                        .filter(([name, kind]) => kind.key && (!choices || choices.includes(name)))
                        .map(
                            ([name, kind]) => element(
                                "button", {onclick: () => answer(name), "data-kind": name}, markIcon(kind), kind.title,
                                element("kbd", {}, kind.key.toUpperCase())));
    card.replaceChildren(
        element("h2", {}, "What kind of step is next?"),
        ...(chapter.question ? [element("p", {}, chapter.question(step))] : []),
        element("div", {class: "answers"}, ...buttons), element("p", {class: "score"}, predict.scoreText()));
  };

  // A fact has a value alone; a guard is no reason, but has to hold.
  const whyRow = ({name, value, sign, limit, holds, isGuard, isFact}) => {
    const cells = [element("td", {}, name), element("td", {}, Lesson.numberText(value))];
    if (isFact) return element("tr", {}, ...cells);
    const answer = element("span", {class: "unseen"}, holds ? " holds" : " does not hold");
    return element(
        "tr", {class: isGuard || !holds ? "" : "holds"}, ...cells, element("td", {}, sign),
        element("td", {}, Lesson.numberText(limit)), element("td", {}, holds ? "✓" : "–", answer));
  };

  // `said` is what stands above it already.
  const why = (card, facts, said) => {
    card.replaceChildren(element("h2", {}, "Why"));
    if (!facts) return card.append(element("p", {class: "soft"}, "Nothing is left to do."));
    const rows = facts.rows.map(whyRow);
    if (facts.title !== said || (rows.length === 0 && !facts.remark)) card.append(element("p", {}, facts.title));
    if (rows.length) card.append(element("table", {}, ...rows));
    if (facts.remark) card.append(element("p", {class: "soft"}, facts.remark));
    return undefined;
  };

  // The current line is lit, and marked for those who do not see colours.
  const code = (card, chapter, lit) => {
    const lines = chapter.code.lines.map(
        (line, i) => element(
            "li", {class: i === lit ? "lit" : "", "aria-current": i === lit ? "step" : null},
            element("code", {}, line.text), line.file ? element("small", {}, `${line.file} · ${line.name}`) : null));
    card.replaceChildren(element("h2", {}, chapter.code.title), element("ol", {class: "code", start: 1}, ...lines));
  };

  // Boxes that are there already stay, so that the focus does.
  const layers = (card, names, shown, toggle) => {
    if (card.names !== names) {
      const boxes = Object.entries(names).map(
          ([number, name]) => element(
              "label", {},
              element("input", {type: "checkbox", "data-layer": number, onchange: () => card.toggle(Number(number))}),
              element("kbd", {}, number), ` ${name}`));
      card.replaceChildren(element("h2", {}, "Layers"), element("div", {class: "layers"}, ...boxes));
      card.names = names;
    }
    card.toggle = toggle;
    for (const box of card.querySelectorAll("input")) box.checked = shown.has(Number(box.dataset.layer));
  };

  // The kinds of this run with their marks, each a button that leads to its next step. How many there are, and where,
  // is part of what predict mode asks for.
  const legend = (line, chapter, hidesCounts, goTo) => {
    line.goTo = goTo;
    // It stays as it is from step to step.
    const shown = {chapter, steps: chapter.steps(), hidesCounts, dark: Lesson.theme.isDark()};
    if (line.shown && Object.keys(shown).every((key) => shown[key] === line.shown[key])) return;
    line.shown = shown;
    const counts = new Map();
    for (const {kind} of chapter.steps()) counts.set(kind, (counts.get(kind) ?? 0) + 1);
    const kinds = Object.entries(chapter.kinds)
                      .filter(([name, kind]) => kind.key && name !== "end" && (hidesCounts || counts.get(name) > 0));
    const items = kinds.map(([name, kind]) => {
      if (hidesCounts) return element("span", {}, markIcon(kind), kind.title);
      const title = `to the next step of this kind: ${kind.title}`;
      return element(
          "button", {title, "aria-label": title, onclick: () => line.goTo(name)}, markIcon(kind), kind.title,
          ` ${counts.get(name)}`);
    });
    line.replaceChildren(...items);
  };

  return {now, next, question, why, code, layers, legend, markIcon};
})();
