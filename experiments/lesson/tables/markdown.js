// The few forms of Markdown that the project's pages use, as elements: headings, paragraphs, lists, tables, blocks of
// code, and within lines bold, emphasis, code and the words of links.
Lesson.markdown = (() => {
  const {element} = Lesson;

  const inline = (text) => {
    const parts = [];
    const pattern = /\*\*([^*]+)\*\*|\*([^*\s][^*]*)\*|`([^`]+)`|\[([^\]]+)\]\([^)]*\)/g;
    let from = 0;
    for (const match of text.matchAll(pattern)) {
      parts.push(text.slice(from, match.index));
      const [, bold, soft, code, link] = match;
      if (bold) parts.push(element("strong", {}, bold));
      if (soft) parts.push(element("em", {}, soft));
      if (code) parts.push(element("code", {}, code));
      if (link) parts.push(link.replaceAll("`", ""));
      from = match.index + match[0].length;
    }
    return [...parts, text.slice(from)].filter((part) => part !== "");
  };

  const cellsOf = (line) => line.split("|").slice(1, -1).map((cell) => cell.trim());

  const table = (lines) => {
    const [head, ...rest] = lines.filter((line) => !/^\|[\s|:-]+\|$/.test(line)).map(cellsOf);
    const row = (cells, name) => element("tr", {}, ...cells.map((cell) => element(name, {}, ...inline(cell))));
    return Lesson.scrolled(
        element("table", {}, row(head, "th"), ...rest.map((cells) => row(cells, "td"))), head.join(", "));
  };

  const code = (lines) => {
    const block = element("pre", {class: "console", tabindex: 0, role: "region", "aria-label": "commands and outputs"});
    lines.forEach((line) => block.append(line.startsWith("$ ") ? element("b", {}, line) : line, "\n"));
    return block;
  };

  // What begins a block of its own.
  const kindOf = (line) => {
    if (line.startsWith("```")) return "code";
    if (line.startsWith("|")) return "table";
    if (line.startsWith("- ")) return "list";
    if (line.startsWith("#")) return "heading";
    return line.trim() === "" ? "nothing" : "text";
  };

  const isOf = {
    table: (line) => line.startsWith("|"),
    list: (line) => line.startsWith("- ") || line.startsWith("  "),
    text: (line) => kindOf(line) === "text",
  };

  const heading = (line) => {
    const [, marks, text] = line.match(/^(#+) (.*)$/);
    return element(`h${Math.min(marks.length + 1, 4)}`, {}, ...inline(text));
  };

  const list = (lines) => {
    const items = [];
    for (const line of lines) {
      if (line.startsWith("- "))
        items.push(line.slice(2));
      else
        items[items.length - 1] += ` ${line.trim()}`;
    }
    return element("ul", {}, ...items.map((item) => element("li", {}, ...inline(item))));
  };

  // The elements of a text.
  return (text) => {
    const lines = text.split("\n");
    const all = [];
    for (let i = 0; i < lines.length;) {
      const kind = kindOf(lines[i]);
      if (kind === "heading") all.push(heading(lines[i]));
      let end = i + 1;
      if (kind === "code") {
        while (end < lines.length && !lines[end].startsWith("```")) ++end;
        all.push(code(lines.slice(i + 1, end)));
        ++end;
      } else if (isOf[kind]) {
        while (end < lines.length && isOf[kind](lines[end])) ++end;
        const block = lines.slice(i, end);
        if (kind === "table") all.push(table(block));
        if (kind === "list") all.push(list(block));
        if (kind === "text") all.push(element("p", {}, ...inline(block.join(" "))));
      }
      i = end;
    }
    return all;
  };
})();

// A wide element scrolls within itself, also by the keyboard.
Lesson.scrolled = (inner, name) =>
    Lesson.element("div", {class: "scrolled", tabindex: 0, role: "region", "aria-label": `table: ${name}`}, inner);
