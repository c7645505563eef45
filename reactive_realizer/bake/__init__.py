"""Bakes the default avatars: clothed, rigged, talking figures (GLB with a VRM 1.0 block) from CC0 MakeHuman data.

A tool that is run by hand; the realizer and its wheel do not depend on it. Lengths are meters, y is up, the
figure faces +z and its left is +x. The same input gives the same bytes.

The steps, each a module or two:

1. body shape and rig: `makehuman`, `rig`, `mouth`, `further_shapes`, `body`
2. clothes: `cloth`, `top`, `lowered_arms`, `neckline`, `pants`, `shoes`
3. hair, eyes and teeth: `skull`, `ribbon`, `strands`, `hair`, `bob`, `crop`, `eyes`, `teeth`
4. skin: `texels`, `head_map`, `hairline`, `face_masks`, `occlusion`, `skin_paint`, `head_texture`, `body_texture`
5. the file: `avatar`, `face`, `textures`, `materials`, `primitive`, `glb`, `vrm`

The other modules are used by all of these: `numeric`, `mesh`, `surgery`, `images`. `characters` describes the avatars.
"""
