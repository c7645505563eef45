import { defineConfig } from "vite";

/** Where `npm run dev` finds a running `reactive-realizer serve`. */
const REALIZER = "http://127.0.0.1:8088";

// The server accepts its own origin only, so the development proxy speaks in its name.
const toRealizer = { target: REALIZER, changeOrigin: true, headers: { Origin: REALIZER } };

export default defineConfig({
  base: "./",
  build: {
    outDir: "dist",
    // The page's Content-Security-Policy allows neither inline scripts nor data: styles and scripts.
    assetsInlineLimit: 0,
    modulePreload: { polyfill: false },
    chunkSizeWarningLimit: 1000,
    // The licenses of what is bundled ask to go with every copy, and the wheel carries one.
    license: { fileName: "licenses.md" },
  },
  server: {
    proxy: {
      "/ws": { ...toRealizer, ws: true },
      "/status": toRealizer,
      "/world": toRealizer,
      "/avatars": toRealizer,
      "/audio": toRealizer,
    },
  },
});
