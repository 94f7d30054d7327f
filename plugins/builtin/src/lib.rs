//! The plugins Seamline comes with, in one table. The first of a stage is the one taken by default.

use seamline_contour_tracking::ContourTrackingSettings;
use seamline_ecs::Registry;
use seamline_gmm::GmmSettings;
use seamline_graph_cut::GraphCutSettings;
use seamline_histogram::HistogramSettings;
use seamline_kmeans::KMeansSettings;
use seamline_mean_shift::MeanShiftSettings;

/// All plugins Seamline comes with, and programs of anybody's own. To add one: a dependency and a line.
pub fn registry() -> Registry {
    Registry::default()
        .with_classifier::<KMeansSettings>()
        .with_classifier::<GmmSettings>()
        .with_classifier::<HistogramSettings>()
        .with_classifier::<MeanShiftSettings>()
        .with_rectifier::<ContourTrackingSettings>()
        .with_rectifier::<GraphCutSettings>()
        .with_commands(seamline_command::systems)
}
