"""Where the user finds the settings, and which of Blender's own panels stay."""

import bpy


class MeninasPanel(bpy.types.Panel):
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    COMPAT_ENGINES = {"MENINAS"}

    @classmethod
    def poll(cls, context):
        return context.engine in cls.COMPAT_ENGINES


class MENINAS_PT_render(MeninasPanel):
    bl_label = "Meninas"
    bl_context = "render"

    def draw(self, context):
        layout, chosen = self.layout, context.scene.meninas
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(chosen, "accuracy", expand=True)
        layout.prop(chosen, {"QUALITY": "quality", "ERROR": "error", "TIME": "seconds"}[chosen.accuracy])
        layout.prop(chosen, "use_mirrors")
        column = layout.column(heading="Passes")
        column.prop(chosen, "use_passes", text="Light")
        column.prop(chosen, "use_lamps")


class MENINAS_PT_actions(MeninasPanel):
    bl_label = "Bake and Animation"
    bl_context = "render"

    def draw(self, context):
        layout = self.layout
        layout.use_property_split = True
        layout.prop(context.scene.meninas, "bake_of")
        layout.operator("meninas.bake", icon="RENDER_STILL")
        layout.operator("meninas.render_animation", icon="RENDER_ANIMATION")


class MENINAS_PT_material(MeninasPanel):
    bl_label = "Meninas"
    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.object is not None and super().poll(context)

    def draw(self, context):
        self.layout.operator("meninas.make_mirror", icon="MOD_MIRROR")


# Panels of other engines that say things Meninas reads.
KEPT = {"EEVEE_MATERIAL_PT_context_material", "EEVEE_MATERIAL_PT_surface", "EEVEE_WORLD_PT_surface",
        "DATA_PT_EEVEE_light"}
NOT_KEPT = {"DATA_PT_light", "RENDER_PT_freestyle", "VIEWLAYER_PT_filter"}


def _shared_panels():
    for panel in bpy.types.Panel.__subclasses__():
        engines = getattr(panel, "COMPAT_ENGINES", None)
        if engines is None or panel.__name__ in NOT_KEPT:
            continue
        if "BLENDER_RENDER" in engines or panel.__name__ in KEPT:
            yield panel


def share_panels():
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.add("MENINAS")


def unshare_panels():
    for panel in _shared_panels():
        panel.COMPAT_ENGINES.discard("MENINAS")


CLASSES = (MENINAS_PT_render, MENINAS_PT_actions, MENINAS_PT_material)
