// Draws every chart from the specification that stands beside it.
"use strict";
(() => {
  const narrow = 640;
  const scrolled = 640; // of the plot of a chart that is wider than the page

  // On a narrow page legends have one column and the kinds of line go below the chart; a chart with
  // many columns keeps its width, and is scrolled.
  function fitted(spec, width, isWide) {
    if (width >= narrow) return spec;
    if (isWide) {
      spec.width = scrolled;
      spec.autosize = { type: "pad", contains: "padding" };
      return spec;
    }
    spec.config.legend.columns = 1;
    for (const layer of spec.layer) {
      for (const [name, channel] of Object.entries(layer.encoding)) {
        if (!channel?.legend) continue;
        channel.legend.columns = 1;
        if (name === "strokeDash") channel.legend.orient = "bottom";
      }
    }
    return spec;
  }

  // Shows the title and the blocks of what a chart's lists have chosen.
  function follow(figure) {
    const lists = [...figure.querySelectorAll('.controls select[name^="chosen_"]')];
    if (lists.length === 0) return;
    const key = lists.map((list) => list.value).join(" | ");
    const titles = figure.querySelector("script.titles");
    const title = titles && JSON.parse(titles.textContent)[key];
    const heading = figure.querySelector("figcaption > :first-child");
    if (title && heading.textContent !== title) heading.textContent = title;
    for (const block of figure.querySelectorAll("[data-choice]")) {
      block.hidden = block.dataset.choice !== key;
    }
  }

  async function draw(figure) {
    const target = figure.querySelector(".drawing");
    const small = figure.classList.contains("small");
    try {
      const spec = JSON.parse(figure.querySelector("script").textContent);
      await vegaEmbed(target, fitted(spec, target.clientWidth, figure.classList.contains("wide")), {
        mode: "vega-lite",
        bind: figure.querySelector(".controls"),
        renderer: "svg",
        actions: small ? false : { export: true, source: false, compiled: false, editor: false },
        downloadFileName: figure.id,
        tooltip: { theme: "light" },
      });
      figure.querySelector(".controls").addEventListener("change", () => follow(figure));
      follow(figure);
      figure.dataset.drawn = "yes";
    } catch (error) {
      figure.dataset.drawn = "no";
      target.textContent = `This chart could not be drawn: ${error.message}`;
      console.error(error);
    }
  }

  const samples = document.getElementById("show-samples");
  if (samples) {
    samples.addEventListener("change", () => {
      document.body.classList.toggle("hide-samples", !samples.checked);
    });
  }
  // A chart in a closed block has no width yet: it is drawn when the block opens.
  function drawWhenOpen(figure) {
    const closed = figure.closest("details:not([open])");
    if (!closed) return draw(figure);
    closed.addEventListener("toggle", () => draw(figure), { once: true });
    return undefined;
  }
  Promise.all([...document.querySelectorAll("figure.chart")].map(drawWhenOpen)).then(() => {
    document.documentElement.dataset.charts = "done";
  });
})();
