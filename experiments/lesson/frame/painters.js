// The two back ends of Lesson.paint: a canvas for the screen, SVG text for slides and tests. Both get screen
// coordinates and styles with colours.
Lesson.CanvasPainter = class {
  // `sheets` keeps what was painted before, for screens that are painted again and again; null: all is painted anew.
  constructor(context, sheets = null) { Object.assign(this, {context, sheets}); }

  sheet(sheet, view, dark, tools) {
    this.stroked = null;
    this.sheets.show(this.context, sheet, view, dark, tools);
  }

  path(points, closed, style) {
    const context = this.context;
    context.beginPath();
    points.forEach(([x, y], i) => (i === 0 ? context.moveTo(x, y) : context.lineTo(x, y)));
    if (closed) context.closePath();
    this.fillAndStroke(style, closed);
  }

  circle(x, y, radius, style) {
    this.context.beginPath();
    this.context.arc(x, y, radius, 0, 2 * Math.PI);
    this.fillAndStroke(style, true);
  }

  text(x, y, text, {size, colour, halo}) {
    const context = this.context;
    this.stroked = null;
    context.font = `${size}px system-ui, sans-serif`;
    context.lineJoin = "round";
    context.lineWidth = 3;
    context.setLineDash([]);
    context.strokeStyle = halo;
    context.strokeText(text, x, y);
    context.fillStyle = colour;
    context.fillText(text, x, y);
  }

  fillAndStroke(style, closed) {
    const context = this.context;
    if (style.fill && closed) {
      context.globalAlpha = style.fillOpacity;
      context.fillStyle = style.fill;
      context.fill();
    }
    if (style.stroke) {
      context.globalAlpha = style.opacity;
      // Thousands of thin lines have the same style; nobody sees how these are joined.
      if (this.stroked !== style) {
        context.strokeStyle = style.stroke;
        context.lineWidth = style.width;
        context.lineJoin = style.width > 1.5 ? "round" : "bevel";
        context.setLineDash(style.dash);
      }
      this.stroked = style;
      context.stroke();
    }
    context.globalAlpha = 1;
  }
};

Lesson.SvgPainter = class {
  constructor(width, height, background) {
    this.width = width;
    this.height = height;
    this.parts = [`<rect width="${width}" height="${height}" fill="${background}"/>`];
  }

  path(points, closed, style) {
    const text = points.map(([x, y]) => `${this.number(x)},${this.number(y)}`).join(" ");
    this.parts.push(`<${closed ? "polygon" : "polyline"} points="${text}"${this.attributes(style, closed)}/>`);
  }

  circle(x, y, radius, style) {
    const [cx, cy, r] = [x, y, radius].map(this.number);
    this.parts.push(`<circle cx="${cx}" cy="${cy}" r="${r}"${this.attributes(style, true)}/>`);
  }

  text(x, y, text, {size, colour, halo}) {
    const escaped = text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/>/g, "&gt;");
    this.parts.push(
        `<text x="${this.number(x)}" y="${this.number(y)}" font-family="sans-serif" font-size="${size}" ` +
        `fill="${colour}" stroke="${halo}" stroke-width="3" stroke-linejoin="round" paint-order="stroke">${
            escaped}</text>`);
  }

  // The file as a whole.
  finish(title) {
    const escaped = title.replace(/&/g, "&amp;").replace(/</g, "&lt;");
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${this.width}" height="${this.height}" ` +
        `viewBox="0 0 ${this.width} ${this.height}" role="img">\n<title>${escaped}</title>\n${
               this.parts.join("\n")}\n</svg>\n`;
  }

  number(value) { return String(Math.round(value * 100) / 100); }

  attributes(style, closed) {
    const fill = style.fill && closed ? `"${style.fill}" fill-opacity="${style.fillOpacity}"` : `"none"`;
    const dash = style.dash.length ? ` stroke-dasharray="${style.dash.join(" ")}"` : "";
    const stroke = style.stroke ? ` stroke="${style.stroke}" stroke-width="${style.width}" stroke-opacity="${
                                      style.opacity}" stroke-linejoin="round"${dash}` :
                                  "";
    return ` fill=${fill}${stroke}`;
  }
};

// The picture of a scene as an SVG file.
Lesson.svgOf = (scene, title, {width = 800, height = 800, layers = null, dark = false} = {}) => {
  const painter = new Lesson.SvgPainter(width, height, Lesson.theme.colour("paper", dark));
  Lesson.paint(scene, new Lesson.View(scene.bounds, width, height), painter, {layers, dark, fontSize: 15});
  return painter.finish(title);
};
