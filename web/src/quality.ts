/** How much the page spends on looks: `?quality=low` is for machines that render without a graphics card. */
export type Quality = "normal" | "low";

/** The quality that the page's address asks for. */
export function qualityOf(address: string): Quality {
  return new URL(address).searchParams.get("quality") === "low" ? "low" : "normal";
}
