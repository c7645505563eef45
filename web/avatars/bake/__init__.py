"""Bakes the default avatars: clothed, rigged, talking figures (GLB with a VRM 1.0 block) from CC0 MakeHuman data.

A tool that is run by hand; the realizer and its wheel do not depend on it. Lengths are meters, y is up, the
figure faces +z and its left is +x. The same input gives the same bytes.

The steps, each a module or two:

1. body shape and rig: `makehuman`, `rig`, `body`
2. head unwrap and paint: `head_map`, `hairline`, `face_masks`, `head_texture`, `textures`
3. clothes: `cloth`, `top`, `neckline`, `pants`, `shoes`
4. hair and eyes: `skull`, `ribbon`, `strands`, `hair`, `bob`, `crop`, `eyes`
5. the file: `avatar`, `face`, `materials`, `primitive`, `glb`, `vrm`

The other modules are used by all of these: `numeric`, `mesh`, `surgery`, `images`. `characters` describes the avatars.
"""
