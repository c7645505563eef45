"""The skin of the head: color, occlusion and roughness, and fine relief, painted in three dimensions."""

import numpy as np
from scipy.ndimage import gaussian_filter

from reactive_realizer.bake.body import Body
from reactive_realizer.bake.characters import Character
from reactive_realizer.bake.face_masks import FaceMasks
from reactive_realizer.bake.head_map import SIZE, HeadMap
from reactive_realizer.bake.images import jpeg, normal_map, orm, picture, shrunk
from reactive_realizer.bake.numeric import Array, value_noise
from reactive_realizer.bake.skin_paint import Paint, SkinTextures, mottled_skin


def paint_head(body: Body, head: HeadMap, exposure: Array) -> SkinTextures:
    """Paint one head, whose vertices (v,) are exposed to light by 0..1."""
    masks = FaceMasks(body, head)
    return SkinTextures(
        color=jpeg(picture(_color(body.character, masks, head.cavity)), 87),
        surface=orm(head.carry(exposure), _roughness(masks), SIZE),
        normal=jpeg(shrunk(_relief(masks), 1024), 82),
    )


def _color(who: Character, masks: FaceMasks, cavity: Array) -> Array:
    paint = Paint(mottled_skin(who, masks.points))
    _flush(paint, who, masks)
    # cavity: warm creases, lit ridges
    paint.pixels *= (1 + 0.05 * np.clip(cavity, -1.4, 0.8))[..., None] ** np.array([0.8, 1.15, 1.25])
    if who.stubble:
        paint.lay(masks.stubble, np.array(who.skin) * [0.42, 0.40, 0.42], who.stubble)
    lips = np.array(who.lips, float)
    paint.lay(masks.lips, lips, who.lip_amount)
    paint.lay(masks.lip_seam, lips * 0.42, 0.92)
    paint.lay(np.clip(masks.brows * 1.15, 0, 1), who.brow, 0.86)
    paint.lay(masks.lash_line, np.array(who.brow) * 0.55, who.liner)
    paint.lay(masks.hairline, np.array(who.hair_color) * 0.8, 0.85)
    return paint.pixels


def _flush(paint: Paint, who: Character, masks: FaceMasks) -> None:
    """Cheeks, tip of the nose, chin and ears are redder, lids and what is below the eyes darker."""
    amount, eye, eye_x, skin = who.flush_amount, masks.eye, masks.eye_x, np.array(who.skin)
    paint.lay(masks.spot(eye_x + 0.014, eye[1] - 0.036, 0.020, 0.015), who.flush, amount)
    paint.lay(masks.spot(0, masks.nose[1] - 0.001, 0.013, 0.012), who.flush, amount * 0.8)
    paint.lay(masks.spot(0, masks.mouth_height - 0.032, 0.016, 0.012), who.flush, amount * 0.45)
    paint.lay(masks.ears, who.flush, amount * 1.2)
    paint.lay(masks.spot(eye_x, eye[1] - 0.013, 0.016, 0.007), skin * [0.80, 0.68, 0.66], 0.22)
    paint.lay(masks.lids, skin * [0.82, 0.68, 0.62], 0.35)


def _roughness(masks: FaceMasks) -> Array:
    points, lips = masks.points, masks.lips
    roughness = 0.56 + 0.03 * value_noise(points * 520 + 31.7) + 0.03 * value_noise(points * 1500)
    nose, forehead = masks.nose[1] + 0.004, masks.eye[1] + 0.045
    shiny = np.maximum(masks.spot(0, nose, 0.010, 0.030), masks.spot(0, forehead, 0.030, 0.016))
    roughness -= 0.10 * shiny
    roughness = roughness * (1 - lips) + 0.50 * lips
    roughness = np.maximum(roughness, 0.8 * np.clip(masks.brows, 0, 1))
    roughness = np.maximum(roughness, 0.85 * masks.lip_seam)
    return np.where(masks.above_hairline > 0, np.maximum(roughness, 0.75), roughness)


def _relief(masks: FaceMasks) -> Array:
    """Pores, the wrinkles of the lips, the hairs of the brows."""
    points, lips = masks.points, masks.lips
    pores = np.abs(value_noise(points * 900)) * -0.6 + 0.5 * value_noise(points * 420)
    pores = pores * (1 - lips) * (1 - 0.6 * masks.lids)
    wrinkles = lips * np.sin(points[..., 0] * 2 * np.pi / 0.0019 + 2.5 * value_noise(points * 300)) * 0.55
    return normal_map(gaussian_filter(pores * 0.45 + wrinkles + masks.brows * 0.5, 0.7), 0.42)
