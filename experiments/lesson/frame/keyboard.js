// What each key does. Commands are words, so that the help is made from the same table and tests can send them.
Lesson.keyboard = (() => {
  const table = [
    {key: "ArrowRight", command: "next", help: "→", does: "next step"},
    {key: "ArrowLeft", command: "back", help: "←", does: "step back"},
    {key: "ArrowRight", shift: true, command: "nextOfKind", help: "Shift →", does: "next step of the same kind"},
    {key: "ArrowLeft", shift: true, command: "backOfKind", help: "Shift ←", does: "last step of the same kind"},
    {key: "PageDown", command: "next", help: "Page ↓", does: "next step, as a presenter's remote sends it"},
    {key: "PageUp", command: "back", help: "Page ↑", does: "step back"},
    {key: "PageDown", shift: true, command: "nextChapter", help: "Shift Page ↓", does: "next chapter"},
    {key: "PageUp", shift: true, command: "backChapter", help: "Shift Page ↑", does: "chapter before"},
    {key: " ", command: "play", help: "Space", does: "play and pause (with less motion: on to another kind)"},
    {key: "Home", command: "first", help: "Home", does: "to the start"},
    {key: "End", command: "last", help: "End", does: "to the end"},
    {key: "p", command: "predict", help: "P", does: "predict the kind of the next step"},
    {key: "e", command: "exercise", help: "E", does: "to the exercise of the chapter"},
    {key: "s", command: "svg", help: "S", does: "save the picture as SVG"},
    {key: "t", command: "theme", help: "T", does: "dark or light"},
    {key: "?", command: "help", help: "?", does: "this list"},
  ];

  // Keys that an element under the focus needs for itself. A box to tick needs no arrows.
  const isBox = (target) => target.tagName === "INPUT" && target.type === "checkbox";
  const isTyping = (target) => /^(INPUT|TEXTAREA|SELECT)$/.test(target.tagName ?? "") && !isBox(target);
  const isPressable = (target) => /^(BUTTON|A|SUMMARY)$/.test(target.tagName ?? "") || isBox(target);

  // {command} or {digit} or {letter} for a key event, null when it is none of ours.
  const commandOf = (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || isTyping(event.target)) return null;
    if (event.key === " " && isPressable(event.target)) return null;
    if (/^[1-9]$/.test(event.key)) return {digit: Number(event.key)};
    const hasShifted = /^(Arrow|Page)/.test(event.key);
    const found = table.find(
        (row) => row.key === (row.key.length === 1 ? event.key.toLowerCase() : event.key) &&
            (!hasShifted || Boolean(row.shift) === event.shiftKey));
    if (found) return {command: found.command};
    return /^[a-z]$/i.test(event.key) ? {letter: event.key.toLowerCase()} : null;
  };

  return {table, commandOf};
})();
