// The words of the paper and of this project, explained where a chapter uses them first: the word can be pointed at,
// touched, or reached by Tab, and then tells what it means.
Lesson.glossary = (() => {
  let meanings = null;
  let pattern = null;

  // The lines of configs/teaching/glossary.md: | word | section | meaning | seen in |.
  const read = () => {
    if (meanings) return meanings;
    const rows =
        (Lesson.data.glossary ?? "").split("\n").filter((line) => line.startsWith("| ") && !line.startsWith("| word"));
    meanings = new Map(rows.map((line) => {
      const [, word, section, meaning] = line.split("|").map((cell) => cell.trim());
      return [word.toLowerCase(), {word, meaning, section}];
    }));
    const words = [...meanings.keys()].sort((a, b) => b.length - a.length);
    pattern = new RegExp(`(?<![\\w-])(${words.join("|")})(s?)(?![\\w-])`, "gi");
    return meanings;
  };

  const show = (term) => {
    const {tip} = Lesson.glossary;
    const {word, meaning, section} = meanings.get(term.dataset.term);
    tip.replaceChildren(Lesson.element("b", {}, word), ` ${meaning}${section === "-" ? "" : ` (section ${section})`}`);
    tip.hidden = false;
    const at = term.getBoundingClientRect();
    const width = Math.min(340, window.innerWidth - 16);
    tip.style.width = `${width}px`;
    tip.style.left = `${Math.max(8, Math.min(at.left, window.innerWidth - width - 8))}px`;
    const above = at.top - tip.offsetHeight - 6;
    tip.style.top = `${at.bottom + 6 + tip.offsetHeight < window.innerHeight || above < 0 ? at.bottom + 6 : above}px`;
  };

  const hide = () => (Lesson.glossary.tip.hidden = true);

  const termOf = (text, key) => Lesson.element(
      "dfn", {
        tabindex: 0,
        "data-term": key,
        "aria-description": meanings.get(key).meaning,
        onfocus: (event) => show(event.target),
        onblur: hide,
        onmouseenter: (event) => show(event.target),
        onmouseleave: hide,
        onkeydown: (event) => event.key === "Escape" && hide()
      },
      text);

  // Where a word is not explained: names, what is pressed, and what is explained already.
  const skipped = "a, button, summary, code, pre, dfn, h1, h2, h3, label, option, textarea, th, .icon";

  // Marks the first use of each word below an element. `seen` has those that are explained, `others` those that mean
  // something else here.
  const mark = (root, seen, others = []) => {
    read();
    if (meanings.size === 0) return;
    const walker = document.createTreeWalker(root, NodeFilter.SHOW_TEXT);
    const texts = [];
    while (walker.nextNode())
      if (!walker.currentNode.parentElement.closest(skipped)) texts.push(walker.currentNode);
    for (const node of texts) {
      const parts = [];
      let from = 0;
      for (const match of node.data.matchAll(pattern)) {
        const key = match[1].toLowerCase();
        if (seen.has(key) || others.includes(key)) continue;
        seen.add(key);
        parts.push(node.data.slice(from, match.index), termOf(match[0], key));
        from = match.index + match[0].length;
      }
      if (parts.length) node.replaceWith(...parts, node.data.slice(from));
    }
  };

  // The one element that shows a meaning.
  const tip = Lesson.element("div", {class: "meaning", role: "tooltip", hidden: true});

  return {read, mark, hide, tip};
})();
