// The cards beside the picture: what happened, what comes next and why, the paper's lines, the layers. Each draws itself
// anew into its element; none keeps a state.
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
        element("p", {class: "sentence"}, markIcon(chapter.kinds[steps[step].kind]), chapter.sentence(step)));
  };

  const next = (card, chapter, step) => {
    const coming = chapter.next(step);
    card.replaceChildren(element("h2", {}, "Next"));
    if (!coming) card.append(element("p", {}, "The run has ended."));
    else card.append(element("p", {}, markIcon(chapter.kinds[coming.kind]), coming.sentence));
  };

  // The question instead of the answer.
  const question = (card, chapter, predict, answer) => {
    const buttons = Object.entries(chapter.kinds).filter(([, kind]) => kind.key).map(([name, kind]) =>
        element("button", {onclick: () => answer(name), "data-kind": name}, markIcon(kind), kind.title,
                element("kbd", {}, kind.key.toUpperCase())));
    card.replaceChildren(element("h2", {}, "What kind of step is next?"), element("div", {class: "answers"}, ...buttons),
                         element("p", {class: "score"}, predict.scoreText()));
  };

  const why = (card, facts) => {
    card.replaceChildren(element("h2", {}, "Why"));
    if (!facts) return card.append(element("p", {class: "soft"}, "Nothing is left to do."));
    card.append(element("p", {}, facts.title));
    const rows = facts.rows.map((row) => element(
        "tr", {class: row.isGuard ? "guard" : row.holds ? "holds" : ""}, element("td", {}, row.name), element("td", {}, Lesson.numberText(row.value)),
        element("td", {}, row.sign), element("td", {}, Lesson.numberText(row.limit)),
        element("td", {}, row.holds ? "✓" : "–", element("span", {class: "unseen"}, row.holds ? " holds" : " does not hold"))));
    if (rows.length) card.append(element("table", {}, ...rows));
    if (facts.remark) card.append(element("p", {class: "soft"}, facts.remark));
    return undefined;
  };

  // The current line is lit, and marked for those who do not see colours.
  const code = (card, chapter, lit) => {
    const lines = chapter.code.lines.map((line, i) => element(
        "li", {class: i === lit ? "lit" : "", "aria-current": i === lit ? "step" : null},
        element("code", {}, line.text),
        line.file ? element("small", {}, `${line.file} · ${line.name}`) : null));
    card.replaceChildren(element("h2", {}, chapter.code.title), element("ol", {class: "code", start: 1}, ...lines));
  };

  const layers = (card, names, shown, toggle) => {
    const boxes = Object.entries(names).map(([number, name]) => element(
        "label", {}, element("input", {type: "checkbox", checked: shown.has(Number(number)),
                                       onchange: () => toggle(Number(number))}),
        element("kbd", {}, number), ` ${name}`));
    card.replaceChildren(element("h2", {}, "Layers"), element("div", {class: "layers"}, ...boxes));
  };

  return {now, next, question, why, code, layers, markIcon};
})();
