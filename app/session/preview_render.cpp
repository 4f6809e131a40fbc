// The rendering thread of the preview.
#include <algorithm>

#include "app/session/background.h"
#include "app/session/preview_health.h"
#include "app/session/preview_impl.h"
#include "engine/color/color_space.h"
#include "engine/compute/backend_registry.h"
#include "engine/pipeline/render_frame.h"

namespace weft {
namespace {

// What is rendered at once; larger plates are shown smaller first.
constexpr std::int64_t kProxyPixels = 640'000;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Only what was touched, on the dark surround: a stage of the way, not a composite.
void isolate(ImageF3& pixels, const Matte& touched) {
    constexpr float kGround = 0.1f;
    for (int y = 0; y < pixels.height(); ++y) {
        for (int x = 0; x < pixels.width(); ++x) {
            const float a = static_cast<float>(touched.at(x, y)) / 255.0f;
            for (int c = 0; c < 3; ++c)
                pixels.pixel(x, y)[c] = kGround + a * (pixels.pixel(x, y)[c] - kGround);
        }
    }
}

// A layer as one looks at it: colours as on the screen, data as grey or red and green.
template <class Picture>
PicturePtr layer_picture(const FrameLayers& layers, const std::string& name,
                         const ColorTransform& out_from_working, Picture&& picture) {
    const Size size = layers.alpha.size();
    if (name == "patch" || name == "edge" || name == "light") {
        ImageF3 pixels = name == "patch"  ? layers.patch
                         : name == "edge" ? layers.edge
                                          : layers.light;
        // Light of 1 changes nothing: it is shown as a middle grey.
        constexpr float kMiddle = 0.18f;
        if (name == "light")
            for (std::size_t i = 0; i < pixels.size_bytes() / sizeof(float); ++i)
                pixels.data()[i] *= kMiddle;
        out_from_working.apply(pixels);
        return picture(pixels);
    }
    ImageU8x3 data(size);
    const auto code = [](float v) {
        return static_cast<std::uint8_t>(std::clamp(v, 0.0f, 1.0f) * 255.0f + 0.5f);
    };
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            std::uint8_t* out = data.pixel(x, y);
            if (name == "st") {
                const float* st = layers.st.pixel(x, y);
                out[0] = code(st[0]), out[1] = code(st[1]), out[2] = 0;
            } else if (name == "id") {
                // Ids are small numbers: each gets a colour of its own.
                const auto id = static_cast<std::uint32_t>(layers.id.at(x, y));
                const std::uint32_t mixed = id * 2654435761u;
                for (int c = 0; c < 3; ++c)
                    out[c] = id == 0 ? 0 : static_cast<std::uint8_t>(64 + (mixed >> (8 * c)) % 192);
            } else {
                const std::uint8_t grey =
                    code(name == "seam" ? layers.seam.at(x, y) : layers.alpha.at(x, y));
                out[0] = out[1] = out[2] = grey;
            }
        }
    }
    return make_picture(std::move(data));
}

// The final picture, and where they are wanted those before it.
template <class Picture>
Expected<PreviewFrame> render_stages(const ShotSource& source, const ShotPlan& given,
                                     const std::vector<RegionScene>& scenes,
                                     const AnalysisStore& store, const Backend& backend, int frame,
                                     bool stages, const std::string& layer, Picture&& picture,
                                     float& seam) {
    PreviewFrame out;
    ShotPlan plan = given;
    plan.layers = true;  // they also tell how the seams fare
    WEFT_TRY(lit, render_frame(source, plan, scenes, store, backend, frame));
    out.stages[static_cast<std::size_t>(Stage::kFinal)] = picture(lit.pixels);
    seam = seam_prominence(lit);
    out.seams = std::make_shared<const SeamPoints>(seam_points(lit));
    if (!layer.empty() && lit.layers) {
        out.layer_name = layer;
        out.layer = layer_picture(*lit.layers, layer, *plan.out_from_working, picture);
    }
    plan.layers = false;
    if (!stages) return out;
    isolate(lit.pixels, lit.touched);
    out.stages[static_cast<std::size_t>(Stage::kLit)] = picture(lit.pixels);
    ShotPlan dark = plan;
    for (RegionPlan& region : dark.regions)
        region.light_source = LightSource::kNone;
    WEFT_TRY(flat, render_frame(source, dark, scenes, store, backend, frame));
    isolate(flat.pixels, flat.touched);
    out.stages[static_cast<std::size_t>(Stage::kTexture)] = picture(flat.pixels);
    return out;
}

std::size_t bytes_of(const PreviewFrame& frame) {
    std::size_t sum = frame.layer ? frame.layer->size_bytes() : 0;
    if (frame.small) sum += frame.small->size_bytes();
    if (frame.seams) sum += frame.seams->size() * sizeof(SeamPoints::value_type);
    for (const PicturePtr& p : frame.stages)
        sum += p ? p->size_bytes() : 0;
    return sum;
}

}  // namespace

Preview::Impl::Impl(AnalysisCacheOptions cache_options, std::string library, std::size_t budget)
    : cache(std::move(cache_options)),
      texture_library(std::move(library)),
      budget_bytes(budget),
      backend(make_cpu_backend()) {
    renderer = std::thread([this] { render_loop(); });
    analyser = std::thread([this] { analyse_loop(); });
}

Preview::Impl::~Impl() {
    {
        const std::lock_guard lock(mutex);
        stop = true;
        analysis_cancel.cancel();
        grow_cancel.cancel();
        card_cancel.cancel();
    }
    wake.notify_all();
    renderer.join();
    analyser.join();
}

void Preview::Impl::set_state(PreviewView::State state, std::string error) {
    const std::lock_guard lock(mutex);
    if (shown.state == state && shown.error == error) return;
    shown.state = state;
    shown.error = std::move(error);
    changed();
}

void Preview::Impl::render_loop() {
    lower_thread_priority();
    std::uint64_t seen = 0;
    for (;;) {
        {
            std::unique_lock lock(mutex);
            const auto news_or_end = [&] { return stop || signals != seen; };
            if (refine_due)
                wake.wait_until(lock, refine_at, news_or_end);
            else
                wake.wait(lock, news_or_end);
            if (stop) return;
            seen = signals;
        }
        while (step()) {
            const std::lock_guard lock(mutex);
            if (stop) return;
        }
    }
}

// One piece of work; false when there is none until something happens.
bool Preview::Impl::step() {
    PreviewRequest now;
    std::string pixels;
    refine_due = false;
    {
        const std::lock_guard lock(mutex);
        if (!wanted || wanted_pixels == failed_pixels) return false;
        now = *wanted;
        pixels = wanted_pixels;
    }
    if (!opened || opened->pixels != pixels) return open_shot_of(now, pixels);
    if (!ready(now.frame))
        set_state(PreviewView::State::kAnalysing);
    else if (step_frame(now))
        return true;
    // Pictures come first, then what is to be said of them.
    return step_fill(now, pixels) || step_card(now) || step_flicker(now);
}

// The frame that is looked at: small at once, at full size when nothing else is wanted.
bool Preview::Impl::step_frame(const PreviewRequest& now) {
    const int factor = factor_of(*opened->shot, kProxyPixels);
    bool shown_small = false, whole = false, may_refine = false;
    {
        const std::lock_guard lock(mutex);
        const auto found = frames.find(now.frame);
        if (found != frames.end()) {
            const PreviewFrame& there = found->second;
            shown_small = !there.approximate && (!now.stages || there.stages[0]) &&
                          (now.layer.empty() || there.layer_name == now.layer);
            whole = shown_small && there.proxy == 1;
        }
        may_refine = !now.hurried && Clock::now() >= refine_at;
    }
    if (!shown_small) return render(now, now.frame, factor);
    if (!whole && may_refine) return render(now, now.frame, 1);
    refine_due = !whole && !now.hurried;
    set_state(PreviewView::State::kIdle);
    return draw_overlay(now);
}

bool Preview::Impl::step_fill(const PreviewRequest& now, const std::string& pixels) {
    const int factor = factor_of(*opened->shot, kProxyPixels);
    for (const int frame : now.fill) {
        {
            const std::lock_guard lock(mutex);
            if (wanted_pixels != pixels) return true;
            const auto found = frames.find(frame);
            if (found != frames.end() && !found->second.approximate) continue;
            if (frame_bytes + frame_bytes / std::max<std::size_t>(1, frames.size()) > budget_bytes)
                return false;
        }
        if (ready(frame)) return render(now, frame, factor);
    }
    return false;
}

// One reader serves all versions of a shot, so that its frames are kept once.
Expected<std::shared_ptr<const Shot>> Preview::Impl::open(const Project& project) {
    OpenShotOptions options;
    options.texture_library = texture_library;
    options.cache_bytes = std::size_t{192} << 20;
    if (reader && reader_of == project.plate) options.plate = reader;
    auto shot = open_shot(project, options);
    if (shot && reader != (*shot)->plate) {
        reader = (*shot)->plate;
        reader_of = project.plate;
        proxies = std::make_unique<ProxyPlates>(std::size_t{128} << 20);
    }
    return shot;
}

bool Preview::Impl::open_shot_of(const PreviewRequest& now, const std::string& pixels) {
    set_state(PreviewView::State::kOpening);
    auto fresh = std::make_shared<OpenedShot>();
    fresh->pixels = pixels;
    fresh->analysis = analysis_key(now.project);
    std::vector<std::string> warnings;
    auto shot = open(now.project);
    Expected<std::shared_ptr<AnalysisStore>> store{nullptr};
    if (shot && opened && opened->analysis == fresh->analysis) {
        store = opened->store;
    } else if (shot) {
        store = open_analysis_cache(**shot, cache, warnings);
    }
    if (!shot || !store) {
        set_state(PreviewView::State::kFailed, (shot ? store.error() : shot.error()).text());
        const std::lock_guard lock(mutex);
        failed_pixels = pixels;
        return false;
    }
    fresh->shot = *shot;
    fresh->store = *store;
    warnings.insert(warnings.end(), (*shot)->warnings.begin(), (*shot)->warnings.end());
    if (auto t = make_color_transform((*shot)->spaces.out, {"srgb"})) srgb_from_out = *t;
    if (auto t = make_color_transform((*shot)->spaces.out, {"linear"})) linear_from_out = *t;
    const bool same_analysis = opened && opened->analysis == fresh->analysis;
    if (!same_analysis) ready_frames.clear();
    // Freed after the lock is: pictures are large.
    std::map<int, PreviewFrame> old_frames;
    OpenedPtr old_opened;
    const std::lock_guard lock(mutex);
    old_opened = std::exchange(opened, fresh);
    old_frames.swap(frames);
    frame_bytes = 0;
    compared.clear();
    for (auto& [region, of_frames] : healths)
        for (auto& [frame, health] : of_frames)
            health.flicker = health.flicker_plate = health.flicker_carried = health.chatter =
                health.seam_motion = health.seam = -1;
    shown.warnings = std::move(warnings);
    changed();
    if (!same_analysis) {
        confidences.clear();
        healths.clear();
        ++mattes;
    }
    const std::vector<int> range = now.range.empty() ? std::vector<int>{now.frame} : now.range;
    if (!same_analysis || analyse_frames != range) {
        if (analysing_key != fresh->analysis) analysis_cancel.cancel();
        to_analyse = fresh;
        analyse_first = {now.frame};
        analyse_frames = range;
        analysis_news = true;
        wake.notify_all();
    }
    return true;
}

bool Preview::Impl::ready(int frame) {
    if (ready_frames.contains(frame)) return true;
    const std::vector<int>& there = opened->shot->plate->frames();
    if (!std::binary_search(there.begin(), there.end(), frame)) return false;
    if (steps_to(*opened, {frame}) > 0) return false;
    ready_frames.insert(frame);
    return true;
}

int Preview::Impl::factor_of(const Shot& shot, std::int64_t pixels) const {
    return ProxyShot::possible(shot) ? proxy_factor(shot.source->size(), pixels) : 1;
}

PicturePtr Preview::Impl::picture_of(const Shot& shot, const ImageF3& pixels) const {
    const bool eight_bit = shot.plan.display_referred && shot.plate->depth() == PixelDepth::kU8;
    return make_picture(pixels, eight_bit, srgb_from_out.get(), linear_from_out.get());
}

Expected<PreviewFrame> Preview::Impl::pictures_of(int frame, bool stages, int factor,
                                                  const std::string& layer) {
    const Shot& shot = *opened->shot;
    float seam = -1;
    const auto note_seam = [&] {
        const std::lock_guard lock(mutex);
        for (const std::size_t k : shot.region_index)
            healths[shot.project.regions[k]->id][frame].seam = seam;
    };
    const auto picture = [&](const ImageF3& pixels) { return picture_of(shot, pixels); };
    if (factor == 1) {
        auto whole = render_stages(*shot.source, shot.plan, scenes.scenes(), *opened->store,
                                   *backend, frame, stages, layer, picture, seam);
        note_seam();
        return whole;
    }
    const ProxyShot small(shot, *opened->store, *proxies, factor);
    const ProxyScenes placed(scenes.scenes(), factor);
    WEFT_TRY(made, render_stages(small.source(), small.plan(), scenes.scenes(), small.store(),
                                 *backend, frame, stages, layer, picture, seam));
    note_seam();
    made.proxy = factor;
    return made;
}

// Grows what the scenes of a shot lack. False after a failure, which is shown.
bool Preview::Impl::grow(const OpenedShot& of) {
    CancelToken token;
    {
        const std::lock_guard lock(mutex);
        if (!opened || wanted_pixels != opened->pixels) return true;
        grow_cancel = token;
    }
    const Status grown = scenes.grow_one(*of.shot, *of.store, of.analysis, token);
    if (grown || token.cancelled()) return true;
    set_state(PreviewView::State::kFailed, grown.error().text());
    const std::lock_guard lock(mutex);
    failed_pixels = of.pixels;
    return false;
}

bool Preview::Impl::render(const PreviewRequest& now, int frame, int factor) {
    const bool usable = scenes.adopt(*opened->shot, opened->analysis);
    const bool first_look = [&] {
        const std::lock_guard lock(mutex);
        return !frames.contains(frame);
    }();
    if (!usable || (!scenes.exact() && !(first_look && frame == now.frame))) {
        set_state(PreviewView::State::kGrowing);
        return grow(*opened);
    }
    if (frame == now.frame) set_state(PreviewView::State::kRendering);
    const auto start = Clock::now();
    auto made = pictures_of(frame, now.stages && frame == now.frame, factor,
                            frame == now.frame ? now.layer : std::string());
    if (!made) {
        set_state(PreviewView::State::kFailed,
                  "Frame " + std::to_string(frame) + ": " + made.error().text());
        const std::lock_guard lock(mutex);
        failed_pixels = opened->pixels;
        return false;
    }
    made->approximate = !scenes.exact();
    keep(now, frame, std::move(*made), seconds_since(start));
    return true;
}

void Preview::Impl::keep(const PreviewRequest& now, int frame, PreviewFrame made, double seconds) {
    std::vector<PreviewFrame> gone;  // freed after the lock is: pictures are large
    const std::lock_guard lock(mutex);
    // What a render would take: a small picture says little about it.
    if (made.proxy == 1 && !made.stages[0]) shown.frame_seconds = seconds;
    if (frame == now.frame) shown.first_seconds = seconds;
    if (const auto before = frames.find(frame); before != frames.end()) {
        frame_bytes -= bytes_of(before->second);
        // What neighbours are compared by stays of one size.
        if (made.proxy == 1 && !before->second.approximate && before->second.comparable() &&
            (before->second.small || before->second.proxy > 1)) {
            made.small = before->second.comparable();
            made.seams = before->second.seams;
        }
    }
    frame_bytes += bytes_of(made);
    gone.push_back(std::exchange(frames[frame], std::move(made)));
    while (frame_bytes > budget_bytes && frames.size() > 1) {
        // The one furthest from where the artist is.
        const auto first = frames.begin(), last = std::prev(frames.end());
        const auto far =
            std::abs(first->first - now.frame) > std::abs(last->first - now.frame) ? first : last;
        frame_bytes -= bytes_of(far->second);
        gone.push_back(std::move(far->second));
        frames.erase(far);
    }
    changed();
}

bool Preview::Impl::draw_overlay(const PreviewRequest& now) {
    if (now.overlay == Overlay::kNone || now.overlay_region == 0) {
        const std::lock_guard lock(mutex);
        if (overlay) changed();
        overlay.reset();
        overlay_key.clear();
        return false;
    }
    const std::string key = opened->pixels + " " + std::to_string(static_cast<int>(now.overlay)) +
                            " " + std::to_string(now.overlay_region) + " " +
                            std::to_string(now.frame);
    if (key == overlay_key) return false;
    const Shot& shot = *opened->shot;
    if (!scenes.adopt(shot, opened->analysis)) return false;
    for (std::size_t k = 0; k < shot.region_index.size(); ++k) {
        if (shot.project.regions[shot.region_index[k]]->id != now.overlay_region) continue;
        auto made = overlays.make(now.overlay, shot, *opened->store, scenes.scenes()[k],
                                  static_cast<int>(k), now.frame, {});
        const std::lock_guard lock(mutex);
        overlay = made ? std::make_shared<const OverlayPicture>(std::move(*made)) : nullptr;
        changed();
    }
    overlay_key = key;
    return true;
}

}  // namespace weft
